#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// What stays for a while takes the top of the view: which model is shown, pending edits and those
/// that no longer apply, questions about the project.
/// \return what is left of the view
[[nodiscard]] ScreenRect draw_banner_strip(PanelContext& context, const ScreenRect& view);

/// Failures with their remedies, comparisons and previews, over the model's part of the view.
/// \return their lower end [pixels]; 0: there is none
[[nodiscard]] float draw_banners(PanelContext& context, const ScreenRect& model);

}  // namespace vesselbench
