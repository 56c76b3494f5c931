#pragma once

#include <array>
#include <cstddef>

#include "geometry/image/image.h"

namespace vesselbench {

/// So many voxels along i, j, k become one.
using VoxelSteps = std::array<int, 3>;

/// Steps by which an image gets at most so many voxels, and these are as near to cubes as can be;
/// 1, 1, 1 for an image that has no more. At least two voxels stay along each axis.
[[nodiscard]] VoxelSteps coarse_steps(const Image& image, std::size_t most_voxels);

/// Means of blocks of voxels.
[[nodiscard]] Image coarse_image(const Image& image, const VoxelSteps& steps);

/// Largest values of blocks of voxels: thin parts of a mask stay whole.
[[nodiscard]] Image coarse_mask(const Image& mask, const VoxelSteps& steps);

}  // namespace vesselbench
