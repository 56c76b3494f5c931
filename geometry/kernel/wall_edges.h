#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// 1 at the corners of the wall's triangles, else 0. #V
[[nodiscard]] std::vector<std::uint8_t> vertices_of_wall(const Surface& surface);

/// How the triangles of the wall meet: a value for each edge between two of them. Edges of caps and
/// rims, whose angles and sizes are made, are left out.
struct WallEdges {
    std::vector<double> angles;       ///< between the two normals [deg]; 0 is flat
    std::vector<double> size_ratios;  ///< of the roots of the two areas [-], at least 1
};

/// Edges at a triangle without area are left out.
[[nodiscard]] WallEdges wall_edges(const Surface& surface);

/// The triangles of the wall beside the vessel that they belong to.
struct WallResolution {
    std::vector<double> edges_around;  ///< circumference by mean edge [-]
    std::vector<double> sags;          ///< height of the lumen's arc over a mean edge [mm]
    std::vector<double> areas;         ///< of the triangles, their weights in shares [mm^2]
};

/// One value for each triangle, or for about `most` evenly chosen ones; none where no wall is
/// opposite.
/// \param distance of the surface
[[nodiscard]] WallResolution wall_resolution(const Surface& surface,
                                             const SurfaceDistance& distance,
                                             std::size_t most = 4000);

}  // namespace vesselbench
