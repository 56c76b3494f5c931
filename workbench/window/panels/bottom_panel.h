#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Below: tabs with history, messages and measures.
void draw_bottom_panel(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
