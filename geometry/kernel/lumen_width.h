#pragma once

#include <optional>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// Width of the lumen at a point of the wall [mm]: the mean of the middle half of twelve rays
/// across it, 30 degrees off the inward normal. In a tube it is the diameter to 1 %, however the
/// rays are turned: those along the axis are too long, those across are too short. Rays that end at
/// a cap or run down a branch are outvoted.
///
/// \param inward unit normal
/// \param farthest rays that hit nothing so far away do not count [mm], > 0
/// \return none if no ray hits anything
[[nodiscard]] std::optional<double> lumen_width(const SurfaceDistance& wall, const Vec3& at,
                                                const Vec3& inward, double farthest);

}  // namespace vesselbench
