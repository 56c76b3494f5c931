#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Above: files, undo and redo, prepare and export, variant, theme and help.
void draw_tool_bar(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
