#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/features/compare/comparison.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

[[nodiscard]] float comparison_banner_height(const Ui& ui);

/// What is compared, how, and by how much they differ, over the view.
/// \return true if the comparison is to be ended
[[nodiscard]] bool draw_comparison_banner(PanelContext& context, Comparison& comparison,
                                          const ScreenRect& rect);

}  // namespace vesselbench
