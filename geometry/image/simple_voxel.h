#pragma once

#include <array>

namespace vesselbench {

/// Whether the voxels around one, and itself, are inside: [13] is its own; i fastest, then j, k.
using VoxelSurroundings = std::array<bool, 27>;

/// True if the voxel may change its side without a change of topology, whichever of the two sides
/// is connected by faces only.
/// Source: Bertrand, Malandain, "A new characterization of three-dimensional simple points",
/// Pattern Recognition Letters 1994.
[[nodiscard]] bool is_simple(const VoxelSurroundings& inside);

}  // namespace vesselbench
