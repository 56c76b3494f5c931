#pragma once

#include <array>

#include <Eigen/Core>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// The grid of the image that a surface was made from.
struct ImageBox {
    std::array<int, 3> size = {0, 0, 0};                             ///< voxels along i, j, k
    Eigen::Matrix4d index_to_patient = Eigen::Matrix4d::Identity();  ///< as of Image [mm]

    /// Edge of a cube as large as a voxel [mm].
    [[nodiscard]] double voxel() const;

    /// True for a cap where the image ends: within a voxel and a half of one of the box's sides,
    /// and nearly parallel to it.
    [[nodiscard]] bool ends_at(const Plane& cap) const;
};

}  // namespace vesselbench
