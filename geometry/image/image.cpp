#include "geometry/image/image.h"

#include <Eigen/LU>

namespace vesselbench {

Vec3 Image::spacing() const {
    return index_to_patient.topLeftCorner<3, 3>().colwise().norm().transpose();
}

Vec3 Image::to_patient(const Vec3& index) const {
    return index_to_patient.topLeftCorner<3, 3>() * index + index_to_patient.topRightCorner<3, 1>();
}

Vec3 Image::to_index(const Vec3& patient) const {
    const Eigen::Matrix3d axes = index_to_patient.topLeftCorner<3, 3>();
    const Vec3 offset = patient - Vec3(index_to_patient.topRightCorner<3, 1>());
    return axes.inverse() * offset;
}

Sampling sampling_of(const Image& image) {
    Sampling sampling;
    sampling.spacing = image.spacing();
    sampling.axes = image.index_to_patient.topLeftCorner<3, 3>().colwise().normalized();
    sampling.confidence = 1.0;
    return sampling;
}

bool same_grid(const Image& a, const Image& b) {
    if (a.size != b.size) return false;
    const double tolerance = 1e-3 * a.spacing().minCoeff();
    const Vec3 far(a.size[0] - 1, a.size[1] - 1, a.size[2] - 1);
    for (const Vec3& corner :
         {Vec3(0, 0, 0), Vec3(far.x(), 0, 0), Vec3(0, far.y(), 0), Vec3(0, 0, far.z())})
        if ((a.to_patient(corner) - b.to_patient(corner)).norm() > tolerance) return false;
    return true;
}

}  // namespace vesselbench
