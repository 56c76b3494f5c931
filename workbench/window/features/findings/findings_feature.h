#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "workbench/findings/dismissals.h"
#include "workbench/session/task.h"
#include "workbench/window/core/core.h"

namespace vesselbench {

/// What looks wrong on the newest model: looked for in the background when it is wanted, shown one
/// after the other, and treated or dismissed as the user says.
class FindingsFeature : public Feature {
public:
    explicit FindingsFeature(Core& core)
        : core_(core), search_(core.wake()), storing_(core.wake()) {}

    /// The panel is seen, or a tour was asked for: begins the search unless the findings are known.
    void want();

    /// Those of the newest model that are not dismissed; none: they are not known.
    [[nodiscard]] const std::optional<JudgedFindings>& findings() const { return findings_; }

    [[nodiscard]] bool is_searching() const { return search_.pending(); }

    /// Why there are none; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return search_.problem(); }

    /// How many of those that are not dismissed are listed: all, or the first ones.
    [[nodiscard]] std::size_t listed() const;

    /// Lists the less certain ones as well, or no longer.
    void unfold(bool all) { unfolded_ = all; }

    /// The one that is looked at; none: none of them.
    [[nodiscard]] const std::optional<std::size_t>& at() const { return at_; }

    /// Looks at a finding, and tries its correction in the background.
    void look_at(std::size_t finding);

    /// Why the correction of a finding is refused, once it has been tried; null: it is not.
    [[nodiscard]] const std::string* refusal(std::size_t finding) const;

    /// Looks at the next finding that is listed, round and round; back with -1.
    void go(int steps);

    /// Runs the operation that treats it. Ignored without one, and of a question: what may be
    /// anatomy is looked at in the form first.
    void treat_at_once(std::size_t finding);

    /// Opens the form of that operation, with its arguments.
    void change(std::size_t finding);

    // --- keeping what was found

    /// A question is answered with "keep" at once. Of anything else, asks for the reason; the same
    /// one again: asks no longer.
    void keep(std::size_t finding);

    /// The finding whose reason is being written; none: nobody is asked.
    [[nodiscard]] const std::optional<std::size_t>& asked() const { return asked_; }

    std::string reason;  ///< as far as it is written

    /// Keeps the finding that was asked about. Ignored while the reason is blank.
    void keep_asked();

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override {
        return search_.pending() || storing_.pending() || trial_.pending();
    }

    void keys(PanelContext& context) override;

    void case_opened() override { forget(); }

    void case_closed() override { forget(); }

private:
    struct Found {
        FindingSearch search;
        std::vector<Dismissal> dismissals;
    };

    void forget();
    void forget_list();
    void judge();
    void try_correction(std::size_t index);
    void end_trial();
    /// \return true if findings of another model were dropped
    bool drop_stale();
    [[nodiscard]] const Finding* finding(std::size_t index) const;
    [[nodiscard]] std::vector<LogEntry> log() const;
    void store(const Finding& kept, const std::string& words);
    [[nodiscard]] Step step_for(const std::string& operation) const;

    Core& core_;
    Task<Found> search_;
    Task<std::vector<Dismissal>> storing_;
    Task<std::string> trial_;  ///< of the correction of the finding that is looked at
    std::map<std::size_t, std::string> refusals_;  ///< by finding; empty: it is not refused
    std::shared_ptr<const Positions> of_;          ///< the surface that was searched last
    Found found_;
    std::optional<JudgedFindings> findings_;
    std::optional<std::size_t> at_, asked_, tried_;
    bool unfolded_ = false;
    int tour_ = 0;  ///< steps to be made when the findings are known
};

}  // namespace vesselbench
