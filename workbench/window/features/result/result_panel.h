#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Draws the card of ResultFeature, which must have one, in the place of the operations: what came
/// out, before and after, and what can be done next.
void draw_result_card(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
