#pragma once

#include "tests/support/iso_surface.h"

namespace vesselbench::test {

/// The outward iso-surface at 0 of a shape (iso_surface).
[[nodiscard]] Surface solid_of(const ImplicitShape& shape, const Eigen::AlignedBox3d& box,
                               double cell);

inline constexpr double kTouchingRadius = 2.0;  ///< of the vessels [mm]
inline constexpr double kTouchingBridge = 0.8;  ///< radius of the bridge between them [mm]

/// Two vessels along x and y, 1 mm apart in z, and a bridge along z through the origin.
[[nodiscard]] Surface touching_vessels(double cell = 0.3);

}  // namespace vesselbench::test
