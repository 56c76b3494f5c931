#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// What looks wrong on the newest model: certainty, evidence, and what can be done with each.
void draw_findings(PanelContext& context);

}  // namespace vesselbench
