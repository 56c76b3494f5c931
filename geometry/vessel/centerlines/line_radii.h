#pragma once

#include <span>
#include <vector>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The place of the centerlines that is nearest to each position, as nearest_place() finds it for
/// one; much faster for many. Empty for a graph without branches.
[[nodiscard]] std::vector<BranchPlace> places_on_nearest_lines(const CenterlineGraph& graph,
                                                               std::span<const Vec3> positions);

/// The vessel's radius [mm] at the place of the centerlines that is nearest to each position.
[[nodiscard]] std::vector<double> radii_of_nearest_lines(const CenterlineGraph& graph,
                                                         std::span<const Vec3> positions);

}  // namespace vesselbench
