#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Left: the ordered steps with their states and edits.
void draw_rail(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
