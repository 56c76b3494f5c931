#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vesselbench {

/// A point or a direction in patient coordinates (LPS), lengths in [mm].
using Vec3 = Eigen::Vector3d;

/// Vertex positions [mm], #V x 3.
using Positions = std::vector<Vec3>;

}  // namespace vesselbench
