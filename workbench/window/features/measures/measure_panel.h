#pragma once

#include "workbench/window/core/panel_context.h"

namespace vesselbench {

/// The kept measures as a table: names to be edited, figures, where and when they were made.
void draw_measure_table(PanelContext& context);

}  // namespace vesselbench
