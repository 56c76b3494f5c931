#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Does what the keys pressed in this frame ask for; keys of the view are the viewport's.
void handle_shortcuts(PanelContext& context);

}  // namespace vesselbench
