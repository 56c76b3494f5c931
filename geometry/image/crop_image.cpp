#include "geometry/image/crop_image.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "geometry/image/vessel_block.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Copies the voxels whose cells meet the index range [low, high].
Image crop_to_indices(const Image& image, const Vec3& low, const Vec3& high) {
    VoxelBlock block;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const int last = image.size[a] - 1;
        if (!(high[axis] >= 0.0 && low[axis] <= last))
            throw InvalidInput(
                "the crop region lies outside the image; give it in mm in the image's patient "
                "coordinates (LPS)");
        const auto bounded = [&](double index) {
            return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(last)));
        };
        // At least two voxels: a surface needs a cell between them.
        block.from[a] = std::min(bounded(std::floor(low[axis])), std::max(0, last - 1));
        block.size[a] =
            std::max(bounded(std::ceil(high[axis])), std::min(block.from[a] + 1, last)) -
            block.from[a] + 1;
    }
    return part_of(image, block);
}

}  // namespace

Image crop_to_box(const Image& image, const Vec3& low, const Vec3& high) {
    if (!((high - low).minCoeff() > 0.0))
        throw InvalidInput("the crop box is empty: its upper corner must be above its lower one");
    Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity()), most = -least;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                     corner & 4 ? high.z() : low.z());
        const Vec3 index = image.to_index(p);
        least = least.cwiseMin(index);
        most = most.cwiseMax(index);
    }
    return crop_to_indices(image, least, most);
}

Image crop_to_sphere(const Image& image, const Vec3& centre, double radius) {
    if (!(radius > 0.0)) throw InvalidInput("the crop radius must be above 0 mm");
    const Vec3 middle = image.to_index(centre);
    const Eigen::Matrix3d to_index = image.index_to_patient.topLeftCorner<3, 3>().inverse();
    // The ball's extent along an index axis is the radius times the gradient of that index.
    const Vec3 reach = radius * to_index.rowwise().norm();
    return crop_to_indices(image, middle - reach, middle + reach);
}

}  // namespace vesselbench
