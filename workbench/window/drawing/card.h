#pragma once

#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Draws a card into ImGui's current window: beside a place of the view, within the view and below
/// its tools.
/// ImGui's cursor is put at its first line.
/// \param width [em] \param lines of controls
/// \return its rectangle
ScreenRect draw_card(const Ui& ui, const ScreenRect& view, const ViewPixel& at, float width,
                     int lines);

}  // namespace vesselbench
