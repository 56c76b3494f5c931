#include "geometry/image/voxels.h"

#include <memory>
#include <utility>

namespace vesselbench {

Image with_voxels(Image grid, std::vector<float> voxels) {
    grid.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return grid;
}

double between_voxels(const Image& image, const VoxelIndex& low, const Vec3& share) {
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
        const int x = c & 1, y = c >> 1 & 1, z = c >> 2 & 1;
        const double weight = (x ? share.x() : 1 - share.x()) * (y ? share.y() : 1 - share.y()) *
                              (z ? share.z() : 1 - share.z());
        if (weight > 0.0) sum += weight * image.at(low[0] + x, low[1] + y, low[2] + z);
    }
    return sum;
}

}  // namespace vesselbench
