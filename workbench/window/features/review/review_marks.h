#pragma once

#include <string>

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

// The pins and distances of reviewers while their review is shown, and those that are not entered
// yet, in ImGui's current window. With reviewer and text those of the chosen edit, or of all edits
// if none is chosen.

void draw_review_marks(PanelContext& context, const PixelView& screen);

/// A slice whose marks are drawn.
struct MarkedSlice {
    std::string item;       ///< before the names of its marks: "slice.axial"
    int axis = 0;           ///< across the slice, 0 to 2
    double position = 0.0;  ///< on it [mm]
    double away = 0.0;      ///< a place so far from the slice lies in it [mm]
};

/// Those that lie in a slice: pins, ends of distances, and the line between two such ends.
void draw_review_marks_in_slice(PanelContext& context, const PixelView& screen,
                                const MarkedSlice& slice);

}  // namespace vesselbench
