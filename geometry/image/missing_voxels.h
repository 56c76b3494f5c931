#pragma once

#include "geometry/image/image.h"
#include "geometry/image/voxel_topology.h"

namespace vesselbench {

/// A mask without the voxels that a segmentation by intensities misses inside a vessel.
struct FilledMask {
    Image mask;
    int closing = 0;              ///< radius of the closing that was needed [voxels]; 0: none
    std::size_t added = 0;        ///< voxels
    VoxelTopology before, after;  ///< of the voxels
};

/// Closes a mask that is full of holes, by the least radius that leaves no more loops than vessels
/// have; another mask, and one that no radius up to 3 would mend, stays as it is.
/// \param mask inside where >= 0.5
[[nodiscard]] FilledMask without_missing_voxels(const Image& mask);

}  // namespace vesselbench
