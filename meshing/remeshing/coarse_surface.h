#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A rough copy for small pictures: the vertices in each cell of a grid become their mean, and
/// triangles that lose a corner vanish. Patches are kept, attributes are not; the copy need not be
/// a manifold. A surface of few vertices is returned as it is.
/// Source: Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex scenes",
/// 1993.
/// \param cells of the grid along the longest side of the bounding box, at least 1
[[nodiscard]] Surface coarse_surface(const Surface& surface, int cells);

}  // namespace vesselbench
