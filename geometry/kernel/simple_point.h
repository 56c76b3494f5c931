#pragma once

#include <cstdint>

namespace vesselbench {

/// The voxels of an object in a block of 3 x 3 x 3: bit k + 1 + 3 (j + 1) ... , i fastest. Bit 13
/// is the voxel in its middle, and is ignored.
using NeighbourBits = std::uint32_t;

/// Those that have a face in common with the middle one.
inline constexpr NeighbourBits kFaceNeighbours =
    1U << 4 | 1U << 10 | 1U << 12 | 1U << 14 | 1U << 16 | 1U << 22;

/// True if a voxel can be removed without changing the topology (26-connected object, 6-connected
/// background).
/// Source: Bertrand and Malandain, "A new characterization of three-dimensional simple points",
/// Pattern Recognition Letters 15, 1994.
[[nodiscard]] bool is_simple(NeighbourBits object);

/// The same whichever of object and background is the one that is connected by faces only.
[[nodiscard]] bool is_simple_both_ways(NeighbourBits object);

/// True if a voxel connects parts of the object that are not connected around it (26-connected).
[[nodiscard]] bool connects_parts(NeighbourBits object);

}  // namespace vesselbench
