#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Over the model's part of the view, which they do not move: what the project asks, which model is
/// shown, pending and stale edits, failures with their remedies, comparisons and previews.
/// \return their lower end [pixels]; 0: there is none
[[nodiscard]] float draw_banners(PanelContext& context, const ScreenRect& model);

}  // namespace vesselbench
