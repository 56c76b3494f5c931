#include "workbench/window/panels/layout.h"

#include <algorithm>

namespace vesselbench {

Layout layout_of(float width, float height, float em) {
    const float bar = em * 3.1F, status = em * 2.0F, line = 1.0F;
    const float side = std::clamp(width * 0.19F, em * 15.0F, em * 19.0F);
    const float right = std::clamp(width * 0.25F, em * 19.0F, em * 25.0F);
    const float below = std::clamp(height * 0.21F, em * 8.5F, em * 17.0F);
    const float top = bar + line, middle = height - top - status - line;
    const float centre = width - side - right - 2 * line;
    Layout layout;
    layout.window = {0, 0, width, height};
    layout.tool_bar = {0, 0, width, bar};
    layout.rail = {0, top, side, middle};
    layout.view = {side + line, top, centre, middle - below - line};
    layout.bottom = {side + line, top + middle - below, centre, below};
    layout.operation = {width - right, top, right, middle};
    layout.status = {0, height - status, width, status};
    // A window manager may make the window smaller than its least size.
    for (ScreenRect* rect : {&layout.window, &layout.tool_bar, &layout.rail, &layout.view,
                             &layout.bottom, &layout.operation, &layout.status}) {
        rect->width = std::max(rect->width, 1.0F);
        rect->height = std::max(rect->height, 1.0F);
    }
    layout.compact = width < em * 62;
    return layout;
}

}  // namespace vesselbench
