#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Below: tabs with history, messages and measures.
void draw_bottom_panel(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
