#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Keys and first steps, over everything.
void draw_help_overlay(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
