#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

[[nodiscard]] float comparison_banner_height(const Ui& ui);

/// What is compared, how, and by how much they differ, over the view. There must be a comparison.
void draw_comparison_banner(PanelContext& context, const ScreenRect& rect);

}  // namespace vesselbench
