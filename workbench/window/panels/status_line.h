#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Below everything: figures of the model, device, progress with a cancel button.
void draw_status_line(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
