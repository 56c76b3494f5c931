#pragma once

#include <span>
#include <vector>

#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// Thins an object to a curve of the same topology: simple voxels are removed in the order of their
/// depth until only the anchors and their connections are left, so the curve's ends are anchors,
/// and its loops are handles of the lumen.
/// Source: Pudney, "Distance-ordered homotopic thinning", CVIU 72, 1998.
/// \param object lumen voxels (all of them, or an earlier curve to be left with fewer ends)
/// \param anchors voxels of the object to keep
/// \return the curve's voxels, ascending
[[nodiscard]] std::vector<VoxelId> thin(const LumenGrid& grid, std::span<const VoxelId> object,
                                        std::span<const VoxelId> anchors, const Progress& progress);

}  // namespace vesselbench
