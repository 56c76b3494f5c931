#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/features/clip/clipped_values.h"
#include "workbench/window/view/view_scene.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// What the view's buttons ask the camera for.
struct ToolRequests {
    bool frame = false, switch_perspective = false;
};

/// The view's buttons, in its upper left corner. \param perspective of the camera
[[nodiscard]] ToolRequests draw_view_tools(PanelContext& context, const ScreenRect& view,
                                           bool perspective);

/// What the colours mean, if the view has room for it.
/// \param clipped remembers its count from frame to frame
/// \return where it is; empty: nowhere
ScreenRect draw_legend(const PanelContext& context, const ViewScene& scene, ClippedCount& clipped);

/// What to do while there is no surface.
void draw_empty_view(PanelContext& context, const ViewScene& scene);

}  // namespace vesselbench
