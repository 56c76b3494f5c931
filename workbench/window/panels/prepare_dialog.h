#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Asks for the purpose, and whether to make what is missing or to start again from a step; lists
/// the operations that will run.
void draw_prepare_dialog(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
