#pragma once

#include <string>

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

struct FrameLook {
    Paint back = 0;      ///< 0: the panels' colour
    float padding = -1;  ///< [pixels]; -1: the usual one
    bool scrolls = true;
    bool floats = false;  ///< over all other panels
    bool bordered = false;
};

/// Begins a part of the window at a place; end_frame() must follow.
void begin_frame(const Ui& ui, const std::string& name, const ScreenRect& rect,
                 const FrameLook& look = {});
void end_frame();

/// Darkens everything drawn so far, and begins a dialog in the middle of it.
/// \return its rectangle
ScreenRect begin_dialog(const Ui& ui, const std::string& name, const ScreenRect& window,
                        float width, float height);

}  // namespace vesselbench
