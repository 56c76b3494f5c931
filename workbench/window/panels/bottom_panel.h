#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Below: tabs with history and messages.
void draw_bottom_panel(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
