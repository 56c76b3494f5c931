#pragma once

#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// Where a field's zero surface passes between neighbouring voxels; the inside is above 0.
struct WallCrossing {
    std::size_t from = 0, to = 0;  ///< offsets of the two voxels
    float share = 0.0f;            ///< of the way from the first to the second
    float area = 0.0f;             ///< [mm^2] of the wall that the crossing stands for
};

/// The areas add up to that of the zero surface (Cauchy and Crofton: each axis sees the part of the
/// wall that faces it).
[[nodiscard]] std::vector<WallCrossing> wall_crossings(const Image& grid,
                                                       const std::vector<float>& field);

/// The share of every voxel that lies above 0 of a field, in [0, 1], by samples between the voxels
/// (trilinear interpolation).
/// \param grid size and spacing \param field one value for each voxel
/// \param crossings of the field
[[nodiscard]] std::vector<float> occupancy(const Image& grid, const std::vector<float>& field,
                                           const std::vector<WallCrossing>& crossings);

}  // namespace vesselbench
