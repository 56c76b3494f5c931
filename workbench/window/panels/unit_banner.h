#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Asks which unit a file is in, while that is in doubt. \return the height it took [pixels]
float draw_unit_banner(PanelContext& c, const ScreenRect& place);

}  // namespace vesselbench
