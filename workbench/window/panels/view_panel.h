#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The options of the view, over its upper left corner, while they are open.
void draw_view_panel(PanelContext& context, const ScreenRect& view);

/// The view's keys, wherever the mouse is.
void handle_view_keys(PanelContext& context);

/// Leaves what Esc leaves in the view. \return false if there is nothing
bool leave_view_mode(PanelContext& context);

}  // namespace vesselbench
