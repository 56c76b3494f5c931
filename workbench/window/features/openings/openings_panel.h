#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// Above the fields of a form of clip-opening: the table of all vessel ends, where each is opened,
/// closed, removed or made the inlet. While the mouse is over it, Up and Down choose an end, Space
/// opens or closes it, and Enter makes it the inlet.
void draw_openings_panel(PanelContext& context);

}  // namespace vesselbench
