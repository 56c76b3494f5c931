#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "workbench/review/page_queue.h"
#include "workbench/review/review.h"
#include "workbench/review/verdict_import.h"
#include "workbench/window/core/core.h"

namespace vesselbench {

/// What reviewers say of the shown variant's edits: read while the review step is shown, exchanged
/// as files, and entered here. All of it runs on the case's thread.
class ReviewFeature : public Feature {
public:
    explicit ReviewFeature(Core& core) : core_(core) {}

    /// As of the last reading; null: it is not known.
    [[nodiscard]] const std::shared_ptr<const Review>& review() const { return review_; }

    /// Why it could not be read; empty: it could.
    [[nodiscard]] const std::string& problem() const { return reading_.problem(); }

    /// True while the step, or the form of the chosen edit, is shown.
    [[nodiscard]] bool is_shown() const;

    // --- what to look at first

    /// The best reason first; none: it was not looked for since the edits have changed.
    [[nodiscard]] const std::optional<std::vector<QueueItem>>& queue() const { return queue_; }

    /// Looks for it, which reads the model after each edit.
    void find_queue();

    /// Chooses the item's edit, and looks at its place.
    void look_at(const QueueItem& item);

    /// True once after look_at(): the list scrolls to the chosen edit.
    [[nodiscard]] bool take_reveals() { return std::exchange(reveals_, false); }

    // --- the edit that is judged

    /// Null: none, or the model has it no longer.
    [[nodiscard]] const ReviewedEdit* chosen() const;

    /// Chooses an edit, or none if it is chosen, and looks at its place.
    void choose(EditId edit);

    /// Opens the form of the chosen edit. If it was rejected, and is changed there, the note of its
    /// new revision says what it answers.
    void correct();

    std::string comment;  ///< on it, while it is written; of a rejection: its reason

    /// Why a verdict on the chosen edit cannot be entered now; empty: it can.
    [[nodiscard]] std::string why_not(Verdict verdict) const;

    /// Enters it with the comment; ignored if why_not() says why.
    void give(Verdict verdict);

    // --- who judges

    /// True until the name is known, and while it is changed.
    [[nodiscard]] bool asks_who() const { return asks_who_ || core_.settings.reviewer.empty(); }

    void ask_who();

    Reviewer who;  ///< the answer, while it is written

    /// Keeps the answer, for this and other cases; ignored without a name.
    void keep_who();

    // --- events

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return reading_.pending(); }

    void case_opened() override { case_closed(); }

    void case_closed() override;

    void applying() override;
    void form_dropped() override;

    [[nodiscard]] float banner(PanelContext& context, const ScreenRect& place) override;

    void file_chosen(FileQuestion question, const std::filesystem::path& file) override;

private:
    /// What a reading depends on: cases, changes of the edits and the variant, changes of verdicts.
    using Version = std::tuple<int, int, int>;

    /// What a corrected edit answers.
    struct Answer {
        EditRef to;         ///< the edit that was rejected
        std::string words;  ///< "answers A. Kern: too smooth"
        bool applied = false;
    };

    [[nodiscard]] const LogEntry* answering_edit() const;
    void note_answer();
    void enter(const std::string& what, std::function<Message(Session&, const Progress&)> work);
    void write_page(const std::filesystem::path& file);
    void import(const std::filesystem::path& file);

    Core& core_;
    Task<Review> reading_;
    std::shared_ptr<const Review> review_;
    std::optional<Version> read_;
    int entered_ = 0;  ///< counts changes of verdicts
    std::optional<EditId> chosen_;
    std::optional<Answer> answer_;
    std::optional<std::vector<QueueItem>> queue_;
    int queue_changes_ = 0;  ///< the document's snapshot changes that it is of
    bool reveals_ = false;
    bool asks_who_ = false;
};

}  // namespace vesselbench
