#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Growth of the edges per distance from the wall that tetrahedralize has by default [-].
constexpr double kUsualGrowth = 0.15;

/// Tetrahedra that would fill the lumen of a surface with these edges: behind every triangle of the
/// wall lies a wedge that ends on the vessel's axis, and the edges in it grow with the depth.
/// \param sizes target edge length at each vertex [mm], #V, > 0
/// \param radii local vessel radius at each vertex [mm], #V
/// \param growth of the edges per distance from the wall [-], > 0
[[nodiscard]] double expected_cells(const Surface& surface, const std::vector<double>& sizes,
                                    const std::vector<double>& radii, double growth = kUsualGrowth);

}  // namespace vesselbench
