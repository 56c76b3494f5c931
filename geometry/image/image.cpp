#include "geometry/image/image.h"

#include <algorithm>

#include <Eigen/LU>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

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

void require_same_place(const Image& image, const Image& mask) {
    constexpr double kSamePlace = 0.1;  // voxels
    const auto size_text = [](const Image& of) {
        return std::to_string(of.size[0]) + " x " + std::to_string(of.size[1]) + " x " +
               std::to_string(of.size[2]);
    };
    if (mask.size != image.size)
        throw InvalidInput("the mask has " + size_text(mask) + " voxels, but the image has " +
                           size_text(image) + ": give the mask made on this image");
    double apart = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 index(corner & 1 ? image.size[0] - 1 : 0, corner & 2 ? image.size[1] - 1 : 0,
                         corner & 4 ? image.size[2] - 1 : 0);
        apart = std::max(apart, (image.to_patient(index) - mask.to_patient(index)).norm());
    }
    if (apart > kSamePlace * image.spacing().minCoeff())
        throw InvalidInput(
            "the mask is at a different place than the image: their corners are up to " +
            formatted(apart) + " mm apart; export it with the image's orientation and spacing");
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
