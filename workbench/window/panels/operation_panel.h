#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Right: the operations of a step, or the form of the chosen one.
void draw_operation_panel(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
