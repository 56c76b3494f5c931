#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// While no case is open: recent projects, open, bundled cases and phantoms.
void draw_start_screen(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
