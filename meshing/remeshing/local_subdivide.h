#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/local_remesh.h"

namespace vesselbench {

/// Splits the triangles that have a vertex in the surroundings of a place into four, `iterations`
/// times; each iteration but the last splits one ring of triangles more, so that sizes grow by
/// steps of two. Triangles beside them are split into two or three. Vertices in the surroundings
/// move by Loop's rules (subdivide()); all others, and those of rims, stay: the surface beyond them
/// is the same, with more triangles. Patches are kept; attributes are averaged at new vertices.
/// Source of the transition: Bank, Sherman, Weiser, "Some refinement algorithms and data structures
/// for regular local mesh refinement", 1983.
/// \param places of the surface
/// \param iterations 1 to 6
/// \throw InvalidInput if an argument is out of its range or the surface is no manifold there;
///        AlgorithmFailure if the result would cross itself; Cancelled
[[nodiscard]] Surface subdivide_near(const Surface& surface, const SurfaceDistance& places,
                                     const NearPlace& near, int iterations,
                                     const Progress& progress = {});

}  // namespace vesselbench
