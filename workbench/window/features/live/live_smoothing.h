#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "workbench/window/case/document.h"
#include "workbench/window/features/live/live_form.h"
#include "workbench/window/features/live/live_model.h"
#include "workbench/window/features/live/parameter_drive.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// What a live model was asked for.
struct SmoothingKey {
    int base = 0, changes = 0;
    ColouringKind colouring = ColouringKind::Patches;

    bool operator==(const SmoothingKey&) const = default;
};

/// The form of an operation that smooths, as the model in the view follows it live: whatever its
/// fields say is computed and shown, without an edit, while the mouse drives some of them. Used by
/// the frame's thread.
class LiveSmoothing : public LiveForm<LiveQuestion, LiveModel, SmoothingKey> {
public:
    /// \param wake called by another thread when update() has something to do
    explicit LiveSmoothing(std::function<void()> wake, const LiveDevice& device = {});

    /// What the model follows in a frame.
    struct Followed {
        const Document& document;
        const OperationForm* form = nullptr;  ///< null: none is open
        ColouringKind colouring = ColouringKind::Patches;
    };

    /// Once a frame. \return true if what is shown has changed
    bool update(const Followed& followed);

    /// Number of the model that is smoothed: equal ones are the same.
    [[nodiscard]] int base() const { return base_number(); }

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

private:
    void take_base(const Followed& followed);
    void ask_for(const Followed& followed);

    std::shared_ptr<const Positions> base_positions_;
    DriveAxes wanted_axes_{"iterations", "lambda", "beta_min"}, axes_;
    std::map<std::string, double> starts_;  ///< of a drag, of parameters that are not given
};

/// Why the outcome of a form cannot be followed, or analysed, without an edit; empty: it can be.
[[nodiscard]] std::string why_not_followed(const LiveSmoothing::Followed& followed);

/// A model and a surface with the same vertices: how far these are apart, if that is more than
/// rounding (1e-5 of the diagonal). Else empty: "up to 0.012 mm"
[[nodiscard]] std::string difference_text(const Surface& shown, const Surface& applied);

}  // namespace vesselbench
