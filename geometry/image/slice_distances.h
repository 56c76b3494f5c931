#pragma once

#include <cstddef>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/image/squared_distances.h"

namespace vesselbench {

/// Signed distances [mm] within slices to the nearest voxel centre of the other side, positive
/// inside; plus or minus kFarSquared in a slice that has one side only. The outline lies midway
/// between voxels, so both kinds of distance include half a voxel.
/// \param mask inside where >= 0.5
/// \param stack axis across the slices, 0 to 2
[[nodiscard]] std::vector<float> signed_slice_distances(const Image& mask, std::size_t stack);

}  // namespace vesselbench
