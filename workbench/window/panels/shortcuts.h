#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// Finds what the keys of this frame ask for (Shown::keys), and does what is not the view's.
void handle_shortcuts(PanelContext& context);

}  // namespace vesselbench
