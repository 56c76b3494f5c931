#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Above: files, undo and redo, prepare and export, variant, theme and help.
void draw_tool_bar(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
