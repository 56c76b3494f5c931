#pragma once

#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Triangles that fill a hole. Corner numbers below the loop's length are the loop's vertices, in
/// its order; the others are `points`, counted on.
struct HolePatch {
    Positions points;  ///< new vertices [mm]
    std::vector<Triangle> triangles;
};

/// Fills a loop of rim vertices with triangles of the size found at its rim, bent to continue the
/// surface smoothly.
/// Source: Liepa, "Filling holes in meshes", 2003; CGAL's triangulate_refine_and_fair_hole.
/// \param around triangles near the loop (two or three rings of them), which lead the bending
/// \param loop closed, in the direction of the half-edges of its triangles
[[nodiscard]] HolePatch fill_hole_smoothly(const Positions& points,
                                           const std::vector<Triangle>& around,
                                           const std::vector<VertexId>& loop);

/// Fills a loop with triangles between its own vertices only.
[[nodiscard]] HolePatch fill_hole_plainly(const Positions& points,
                                          const std::vector<VertexId>& loop);

}  // namespace vesselbench
