#include "geometry/vessel/ends/image_box.h"

#include <cmath>

#include <Eigen/Dense>

namespace vesselbench {

namespace {

/// Smoothing moves a cap [voxels].
constexpr double kReach = 1.5;
constexpr double kParallel = 0.94;  // 20 degrees

}  // namespace

double ImageBox::voxel() const {
    return std::cbrt(std::abs(index_to_patient.topLeftCorner<3, 3>().determinant()));
}

bool ImageBox::ends_at(const Plane& cap) const {
    const Eigen::Matrix4d to_index = index_to_patient.inverse();
    const Eigen::Vector4d index = to_index * cap.point.homogeneous();
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 side = to_index.row(axis).head<3>().transpose().normalized();
        const double most = size[static_cast<std::size_t>(axis)] - 1.0;
        const double facing = side.dot(cap.normal);
        if ((facing < -kParallel && index[axis] < kReach) ||
            (facing > kParallel && index[axis] > most - kReach))
            return true;
    }
    return false;
}

}  // namespace vesselbench
