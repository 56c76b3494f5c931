#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// The part of a smoothing form that opens the gallery of suggestions, and lists the spots.
void draw_gallery_panel(PanelContext& context);

}  // namespace vesselbench
