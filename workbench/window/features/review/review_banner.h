#pragma once

#include "workbench/review/review.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Why a rejected edit is corrected, over the view, with the way back to the review.
/// \param place whose top it takes
/// \return its height [pixels]
float draw_review_banner(PanelContext& context, const ReviewedEdit& edit, const ScreenRect& place);

}  // namespace vesselbench
