#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// The pins of reviewers while their review is shown, in ImGui's current window: with their texts
/// those of the chosen edit, or of all edits if none is chosen.
void draw_review_pins(PanelContext& context, const PixelView& screen);

}  // namespace vesselbench
