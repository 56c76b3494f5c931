#pragma once

#include <functional>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// A function that is negative inside, in [mm].
using ImplicitShape = std::function<double(const Vec3&)>;

/// The raw iso-surface at 0 as extracted from an image (vtkFlyingEdges3D, slivers included),
/// outward.
/// \param cell edge of the sampling grid [mm]
[[nodiscard]] Surface iso_surface(const ImplicitShape& shape, const Eigen::AlignedBox3d& box,
                                  double cell);

/// Distance from a capsule around a segment [mm].
[[nodiscard]] double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double radius);

/// Every vertex moved by a normal deviate of `amount` mean edges in each coordinate.
[[nodiscard]] Surface with_noise(const Surface& surface, double amount);

}  // namespace vesselbench::test
