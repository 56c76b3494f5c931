#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/features/live/parameter_drive.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The right mouse button in the view: while it is held, movements drive parameters of the form
/// (thesis 6.3.5).
class DriveControl {
public:
    /// Once a frame, while the view's area is ImGui's last item. \param over it shows the model
    /// there
    void update(PanelContext& context, bool over);

    /// The case is closed.
    void forget() { state_ = State::Idle; }

    /// What can be driven, or is. \param over the mouse is over the model
    void draw(const PanelContext& context, const ScreenRect& view, bool over) const;

private:
    enum class State {
        Idle,
        Driving,
        Dropped  ///< cancelled, but the button is still down
    };

    void begin(PanelContext& context);
    void follow(PanelContext& context);

    State state_ = State::Idle;
    ViewPixel last_ = ViewPixel::Zero();
    DriveReach reach_;
};

}  // namespace vesselbench
