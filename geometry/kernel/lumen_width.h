#pragma once

#include <vector>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// Width of the lumen at a point of the wall [mm]: the median length of rays across it, in a cone
/// of 30 degrees about the inward normal. In a tube the rays along the axis are too long by as much
/// as those across are too short. A ray that hits nothing within `farthest` does not count. \param
/// inward unit normal \return 0 if no ray hits anything
[[nodiscard]] double lumen_width(const SurfaceDistance& wall, const Vec3& at, const Vec3& inward,
                                 double farthest);

}  // namespace vesselbench
