#pragma once

#include "workbench/window/core/core.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Leaves the case or the window, unless an edit runs: then it asks.
void leave(Core& core, Shown& shown, Leaving what);

/// The question whether to cancel a running edit, while one is asked. It goes with the edit.
void draw_leaving_dialog(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
