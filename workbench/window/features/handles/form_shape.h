#pragma once

#include <string>
#include <vector>

#include "workbench/window/drawing/handle.h"
#include "workbench/window/drawing/region_lines.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// A text beside a point of the view.
struct ViewNote {
    Vec3 point = Vec3::Zero();  ///< [mm]
    std::string text;
    bool below = false;  ///< a little lower than beside it, where other marks are near
};

/// What a form shows in the view, and what can be dragged there.
struct FormShape {
    std::vector<RegionLine> lines;
    std::vector<Handle> handles;
    std::vector<ViewNote> notes;
};

}  // namespace vesselbench
