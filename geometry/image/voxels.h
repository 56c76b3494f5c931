#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// i, j, k of a voxel.
using VoxelIndex = std::array<int, 3>;

/// The voxel at an offset in the image, the inverse of Image::offset.
[[nodiscard]] inline VoxelIndex index_of(const Image& image, std::size_t offset) {
    const auto ni = static_cast<std::size_t>(image.size[0]),
               nj = static_cast<std::size_t>(image.size[1]);
    return {static_cast<int>(offset % ni), static_cast<int>(offset / ni % nj),
            static_cast<int>(offset / ni / nj)};
}

/// True if the image has such a voxel.
[[nodiscard]] inline bool holds(const Image& image, const VoxelIndex& at) {
    for (std::size_t a = 0; a < 3; ++a)
        if (at[a] < 0 || at[a] >= image.size[a]) return false;
    return true;
}

/// The grid with other values, as many as it has voxels.
[[nodiscard]] Image with_voxels(Image grid, std::vector<float> voxels);

/// Linear between a voxel and the next one along each axis.
/// \param low,share the voxel, and how far beyond it [voxels], in [0, 1]
[[nodiscard]] double between_voxels(const Image& image, const VoxelIndex& low, const Vec3& share);

/// The smallest box of voxels that holds some.
struct VoxelBox {
    VoxelIndex low = {0, 0, 0}, high = {0, 0, 0};
    std::size_t count = 0;  ///< of voxels that were added

    void add(const VoxelIndex& at) {
        if (count++ == 0) low = high = at;
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], at[a]);
            high[a] = std::max(high[a], at[a]);
        }
    }
};

}  // namespace vesselbench
