#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The least radius_ratio of each vertex's triangles [-], #V: 1 is equilateral, 0 degenerate;
/// not-a-number without triangles.
[[nodiscard]] std::vector<double> worst_triangle_quality(const Surface& surface);

}  // namespace vesselbench
