#pragma once

#include <vector>

#include "geometry/image/image.h"
#include "geometry/image/voxel_band.h"

namespace vesselbench {

/// Gives back their side to voxels whose change would alter the topology of a mask, or thin it
/// away: only voxels of the outline may change sides, one by one, where that is simple
/// (simple_point.h), and no voxel leaves a part that is as thin as itself.
/// \param before positive inside the mask
/// \param band of the mask
/// \param values to be changed: per voxel, positive inside
void keep_topology(const Image& before, const VoxelBand& band, std::vector<float>& values);

}  // namespace vesselbench
