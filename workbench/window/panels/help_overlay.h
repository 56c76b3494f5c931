#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Keys and first steps, over everything.
void draw_help_overlay(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
