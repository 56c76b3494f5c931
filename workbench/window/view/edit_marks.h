#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// Marks where the edit was made that is pointed at in the rail or in the view.
/// \param over the cursor is over the view, and points at nothing else there
void draw_edit_marks(PanelContext& context, const PixelView& screen, bool over);

}  // namespace vesselbench
