#pragma once

#include <functional>
#include <string>

#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// What one call of TetGen left: a mesh, or the code and the text of its error.
struct TetgenResult {
    VolumeMesh mesh;                   ///< empty when it failed
    int error_code = 0;                ///< 0: done; TetGen's own codes otherwise
    std::string error;                 ///< what the code means
    std::vector<TriangleId> culprits;  ///< intersecting input facets (switch `d`), ascending
};

/// True where a tetrahedron of this volume [mm^3] and centroid is larger than wanted.
using TooLarge = std::function<bool(const Vec3& centroid, double volume)>;

/// Calls TetGen once, errors turned into a result (TetGen's exit path is replaced,
/// tetgen_guard.cpp). Input facets carry their patch as marker; the boundary triangles come back
/// outward with their patches. A NaN coordinate aborts the process: check the surface first
/// (surface_check.h). Source: Si, "TetGen, a Delaunay-based quality tetrahedral mesh generator",
/// ACM TOMS 2015.
/// \param switches TetGen's, without the dash, beginning with "p"
/// \param too_large refinement wish, or empty; used with the switch `q` only
[[nodiscard]] TetgenResult run_tetgen(const Surface& surface, const std::string& switches,
                                      const TooLarge& too_large = {});

/// Pairs of facets that TetGen finds to intersect (switch `d`), as one ascending list of triangles.
[[nodiscard]] std::vector<TriangleId> tetgen_intersecting_facets(const Surface& surface);

}  // namespace vesselbench
