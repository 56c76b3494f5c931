#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Shows Shown::note, which must be set, in a dialog, until it is saved or dropped.
void draw_note_dialog(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
