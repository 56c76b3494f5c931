#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Asks for the purpose and lists the operations that will run.
void draw_prepare_dialog(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
