#pragma once

#include <cstddef>
#include <optional>

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/handles/crop_handles.h"

namespace vesselbench {

/// The region of a form that crops, in a 2D view: its handles are dragged there, and a rectangle
/// that is drawn becomes the box. What that does is decided in the model's rooms.
class SliceCrop {
public:
    explicit SliceCrop(SlicePlane plane) : plane_(plane) {}

    /// Once a frame, while the view's area is ImGui's last item, before it follows the mouse.
    void update(PanelContext& context, const PixelView& screen);

    /// True if a drag with the left button does not move the cross.
    [[nodiscard]] bool holds_left() const {
        return state_ != State::Idle && state_ != State::Pressed;
    }

    void draw(PanelContext& context, const PixelView& screen) const;

private:
    enum class State {
        Idle,
        Pressed,  ///< beside the handles: a rectangle begins if the mouse moves
        Handle,
        Rectangle,
        Dropped  ///< cancelled, but the button is still down
    };

    void take_shape(const PanelContext& context);
    void press(PanelContext& context, const PixelView& screen);
    void begin(PanelContext& context, State state);
    void follow(PanelContext& context, const PixelView& screen) const;
    [[nodiscard]] std::optional<std::size_t> hot(const PanelContext& context,
                                                 const PixelView& screen) const;

    SlicePlane plane_;
    FormShape shape_;
    State state_ = State::Idle;
    std::optional<std::size_t> hot_;  ///< the handle under the cursor, or that is dragged
    Handle start_;                    ///< as it was when the drag began; of a rectangle: its corner
    ViewPixel offset_ = ViewPixel::Zero();  ///< from the handle to the cursor
};

}  // namespace vesselbench
