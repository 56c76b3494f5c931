#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Failures with their remedies, previews and pending edits, over the view.
void draw_banners(PanelContext& context, const ScreenRect& view);

}  // namespace vesselbench
