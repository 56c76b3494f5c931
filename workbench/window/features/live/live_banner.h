#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/features/live/live_smoothing.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// How far the model follows, and what the smoothing changes; its button ends it.
/// \param place whose top it takes
/// \return its height [pixels]
[[nodiscard]] float draw_live_banner(PanelContext& context, LiveSmoothing& live,
                                     const ScreenRect& place);

}  // namespace vesselbench
