#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// True if a voxel can be removed without changing the topology (26-connected object, 6-connected
/// background).
/// Source: Bertrand and Malandain, "A new characterization of three-dimensional simple points",
/// Pattern Recognition Letters 15, 1994.
/// \param neighbourhood bit k + 1 + 3 (j + 1) ... of the 3 x 3 x 3 block, i fastest; bit 13 is the
/// voxel itself and is ignored
[[nodiscard]] bool is_simple(std::uint32_t neighbourhood);

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
