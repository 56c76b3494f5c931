#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/stopwatch.h"
#include "workbench/window/model/document.h"
#include "workbench/window/model/live_model.h"
#include "workbench/window/model/operation_form.h"
#include "workbench/window/model/parameter_drive.h"

namespace vesselbench {

/// The form of an operation that smooths, as the model in the view follows it live: whatever its
/// fields say is computed and shown, without an edit, while the mouse drives some of them. Used by
/// the frame's thread.
class LiveSmoothing {
public:
    /// \param wake called by another thread when update() has something to do
    explicit LiveSmoothing(std::function<void()> wake);

    /// What the model follows in a frame.
    struct Followed {
        const Document& document;
        const OperationForm* form = nullptr;  ///< null: none is open
        Step step = Step::Source;             ///< of the form's edit
        ColouringKind colouring = ColouringKind::Patches;
    };

    /// Once a frame. \return true if what is shown has changed
    bool update(const Followed& followed);

    /// True if the form is of an operation that smooths.
    [[nodiscard]] bool has_form() const { return has_form_; }

    /// Why the model cannot follow the form; empty: it can.
    [[nodiscard]] const std::string& why_not() const { return why_not_; }

    [[nodiscard]] bool can_follow() const { return has_form_ && why_not_.empty(); }

    /// Begins or ends to show what the form says.
    void follow(bool on);

    [[nodiscard]] bool follows() const { return on_; }

    /// Number of the model that is smoothed: equal ones are the same.
    [[nodiscard]] int base() const { return base_; }

    /// What the view shows instead of the document's scene; null: nothing.
    [[nodiscard]] const std::shared_ptr<const LiveModel>& shown() const { return shown_; }

    /// The last model, also while something else is shown; null: none.
    [[nodiscard]] const std::shared_ptr<const LiveModel>& model() const { return models_.newest(); }

    /// True while shown() does not answer the form as it is now.
    [[nodiscard]] bool outdated() const;

    /// Why the form cannot be answered; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return models_.problem(); }

    [[nodiscard]] bool pending() const { return on_ && models_.pending(); }

    // --- the mouse

    /// The parameters that it drives.
    [[nodiscard]] const DriveAxes& axes() const { return axes_; }

    void set_axes(const DriveAxes& axes) { wanted_axes_ = axes_ = axes; }

    /// A drag begins.
    void begin_drive();

    /// The texts after a movement since begin_drive().
    /// \param before the form at that time
    [[nodiscard]] std::vector<FieldText> drive(const OperationForm& before,
                                               const DriveReach& reach);

    /// The drag is cancelled: what was not followed before it is no longer.
    void cancel_drive();

private:
    void take_base(const Followed& followed);
    void ask(const Followed& followed);
    [[nodiscard]] bool is_worked_on() const;
    [[nodiscard]] std::string reason_against(const Followed& followed) const;

    /// What a question was asked for.
    struct Asked {
        int base = -1, changes = -1;
        ColouringKind colouring = ColouringKind::Patches;

        bool operator==(const Asked&) const = default;
    };

    LiveModels models_;
    std::shared_ptr<const LiveModel> shown_;
    bool on_ = false, has_form_ = false, on_before_drive_ = false;
    std::string why_not_;
    std::shared_ptr<const Positions> base_positions_;
    int base_ = 0;
    const Operation* operation_ = nullptr;
    Asked asked_;
    std::uint64_t question_ = 0;
    Stopwatch since_asked_;
    DriveAxes wanted_axes_{"iterations", "lambda", "beta_min"}, axes_;
    std::map<std::string, double> starts_;  ///< of a drag, of parameters that are not given
};

/// A model and a surface with the same vertices: how far these are apart, if that is more than
/// rounding (1e-5 of the diagonal). Else empty: "up to 0.012 mm"
[[nodiscard]] std::string difference_text(const Surface& shown, const Surface& applied);

}  // namespace vesselbench
