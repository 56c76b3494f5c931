#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// The kept measures while measuring, or while their table is shown, in ImGui's current window.
void draw_measures(PanelContext& context, const PixelView& screen);

/// Those that lie in a slice.
/// \param axis across the slice, 0 to 2 \param position of the slice on it [mm]
/// \param away distance of a point from the slice up to which it lies in it [mm]
void draw_measures_in_slice(PanelContext& context, const PixelView& screen, int axis,
                            double position, double away);

}  // namespace vesselbench
