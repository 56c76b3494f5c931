#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

class ReviewFeature;

/// The verdict on what is chosen, until it is entered: comment, marks, buttons, and who judges.
void draw_judging(PanelContext& context, ReviewFeature& feature);

}  // namespace vesselbench
