#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// The state of the review, page and verdicts as files, and the edits by step, of which the chosen
/// one is judged.
void draw_review_panel(PanelContext& context);

}  // namespace vesselbench
