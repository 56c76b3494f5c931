#pragma once

#include <functional>
#include <string>

#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Result of one call of TetGen: a mesh, or the code and text of its error.
struct TetgenResult {
    VolumeMesh mesh;                   ///< in_space_order; empty if it failed
    int error_code = 0;                ///< 0: done; TetGen's own codes otherwise
    std::string error;                 ///< the meaning of the code
    std::vector<TriangleId> culprits;  ///< intersecting input facets (switch `d`), ascending
};

/// True if a tetrahedron of this volume [mm^3] at this centroid exceeds the target size.
using TooLarge = std::function<bool(const Vec3& centroid, double volume)>;

/// Calls TetGen once and turns errors into a result (TetGen's exit path is replaced,
/// tetgen_guard.cpp). Input facets carry their patch as marker; the boundary triangles come back
/// outward with their patches. A NaN coordinate aborts the process: check the surface first
/// (surface_check.h).
/// Source: Si, "TetGen, a Delaunay-based quality tetrahedral mesh generator", ACM TOMS 2015.
/// \param switches TetGen's, without the dash, beginning with "p"
/// \param too_large size criterion of the refinement, or empty; used only with the switch `q`
[[nodiscard]] TetgenResult run_tetgen(const Surface& surface, const std::string& switches,
                                      const TooLarge& too_large = {});

/// Pairs of facets that intersect according to TetGen (switch `d`), as one ascending list.
[[nodiscard]] std::vector<TriangleId> tetgen_intersecting_facets(const Surface& surface);

}  // namespace vesselbench
