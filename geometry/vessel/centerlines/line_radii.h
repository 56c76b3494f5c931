#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The vessel's radius [mm] at the place of the centerlines that is nearest to each position.
[[nodiscard]] std::vector<double> radii_of_nearest_lines(const CenterlineGraph& graph,
                                                         std::span<const Vec3> positions);

}  // namespace vesselbench
