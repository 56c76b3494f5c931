#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// Radius of the trunk of a forked vessel [mm].
inline constexpr double kForkTrunk = 2.0;

/// A trunk along z, below the origin, that parts there into two daughters, by the radii of the two
/// [mm]. All ends are open rims: that of the trunk at z = -18, those of the daughters at z = 14.
/// \param scale of all lengths [-]
[[nodiscard]] Surface forked_vessel(double left, double right, double scale = 1.0);

}  // namespace vesselbench::test
