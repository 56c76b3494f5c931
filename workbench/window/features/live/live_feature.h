#pragma once

#include <memory>

#include "workbench/window/core/core.h"
#include "workbench/window/features/live/live_smoothing.h"

namespace vesselbench {

/// The model follows a smoothing form, and movements of the mouse drive its values.
class LiveFeature : public Feature {
public:
    /// \param device of live smoothing
    LiveFeature(Core& core, const LiveDevice& device) : core_(core), live_(core.wake(), device) {}

    /// The form's model, followed live.
    [[nodiscard]] LiveSmoothing& live() { return live_; }

    /// What is followed: the model, the form and the colours of now.
    [[nodiscard]] LiveSmoothing::Followed followed() const;

    /// True if movements of the mouse can drive fields of the form.
    [[nodiscard]] bool can_drive() const;

    /// As Core::begin_drag(), and the model follows the form from now on. end_drag() keeps the
    /// values, cancel_drag() brings back those from before.
    void begin_driving();

    [[nodiscard]] bool is_driving() const { return core_.is_dragging(driven_); }

    /// \param reach since begin_driving()
    void drive(const DriveReach& reach);

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return live_.pending(); }

    [[nodiscard]] float banner(PanelContext& context, const ScreenRect& place) override;
    void form_dropped() override;
    void drag_undone() override;
    void applying() override;

private:
    void tell_difference();
    void tell_fallback();

    Core& core_;
    LiveSmoothing live_;
    int driven_ = 0;                                 ///< number of the drag that drives fields
    std::shared_ptr<const LiveModel> applied_live_;  ///< what was shown when a form was applied
    std::shared_ptr<const Positions> applied_to_;    ///< of the model at that time
    bool told_fallback_ = false;                     ///< that the device has failed
};

}  // namespace vesselbench
