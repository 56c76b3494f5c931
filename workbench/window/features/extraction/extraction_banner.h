#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/features/extraction/live_extraction.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// How far the surface follows; its button ends it.
/// \param place whose top it takes
/// \return its height [pixels]
[[nodiscard]] float draw_extraction_banner(PanelContext& context, LiveExtraction& extraction,
                                           const ScreenRect& place);

}  // namespace vesselbench
