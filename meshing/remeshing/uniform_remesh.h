#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Remeshes every patch to one edge length [mm] with CGAL's isotropic remeshing; rims and open
/// boundaries are split and collapsed only along themselves. Attributes are not carried over.
/// Source: CGAL 5.5 Polygon Mesh Processing, after Botsch & Kobbelt 2004.
/// \throw InvalidInput if the surface is not an oriented manifold
[[nodiscard]] Surface remesh_uniform(const Surface& surface, double edge);

}  // namespace vesselbench
