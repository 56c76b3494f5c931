#pragma once

#include <optional>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// Width of the lumen at a point of the wall [mm]: the mean length of three pairs of opposite rays
/// across it, 30 degrees off the inward normal, of each pair the shorter (the other may run down a
/// branch). In a tube the mean is its diameter to 0.1 %, however the pairs are turned: those along
/// the axis are too long by as much as those across are too short.
///
/// \param inward unit normal
/// \param farthest rays that hit nothing so far away do not count [mm], > 0
/// \return none if no ray hits anything
[[nodiscard]] std::optional<double> lumen_width(const SurfaceDistance& wall, const Vec3& at,
                                                const Vec3& inward, double farthest);

}  // namespace vesselbench
