#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// While no case is open: recent projects, open, bundled cases and phantoms.
void draw_start_screen(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
