#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// The tree of states as a table; a click goes to a state.
void draw_history(PanelContext& context);

}  // namespace vesselbench
