#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Left: the ordered steps with their states and edits.
void draw_rail(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
