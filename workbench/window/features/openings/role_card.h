#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// Asks for the role of the opening that was clicked, beside it; nothing if none was.
void draw_role_card(PanelContext& context, const PixelView& screen);

}  // namespace vesselbench
