#pragma once

#include <vector>

#include "workbench/window/model/operation_form.h"

namespace vesselbench {

/// A line that shows a typed region.
struct RegionLine {
    Positions points;  ///< [mm]
    bool closed = false;

    bool operator==(const RegionLine&) const = default;
};

/// The region of a form as lines: the edges of a box (`box`), three great circles of a ball
/// (`centre` and `radius`). Empty if it has none, or none is typed completely.
[[nodiscard]] std::vector<RegionLine> region_lines(const OperationForm& form);

}  // namespace vesselbench
