#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Shows Shown::note, which must be set, in a dialog, until it is saved or dropped.
void draw_note_dialog(PanelContext& context, const ScreenRect& window);

}  // namespace vesselbench
