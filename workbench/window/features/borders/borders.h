#pragma once

#include "workbench/window/core/layout.h"
#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// Draws the border of a panel. A drag resizes the panel, and folds it where it would get too
/// narrow; a click folds or unfolds it. A double click gives the slices, which are not folded,
/// their usual size.
void draw_border(PanelContext& context, const Border& border);

}  // namespace vesselbench
