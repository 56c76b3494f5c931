#pragma once

#include <cstdint>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// The voxels that count as neighbours: those sharing a face (6), or a face, edge or corner (26).
enum class Neighbourhood { Faces = 6, All = 26 };

/// Connected sets of voxels.
struct VoxelComponents {
    std::vector<std::int32_t> labels;  ///< per voxel: 0 outside, else 1...sizes.size()
    std::vector<std::size_t> sizes;    ///< [voxels], by label - 1, in the order of first voxels
};

/// Connected components of the voxels with a value of at least `threshold`.
[[nodiscard]] VoxelComponents voxel_components(const Image& image, double threshold,
                                               Neighbourhood neighbourhood);

/// Topology of a set of voxels, taken as a union of closed boxes (26-neighbours are connected).
struct VoxelTopology {
    std::int64_t components = 0;  ///< connected pieces
    std::int64_t cavities = 0;    ///< cavities not connected to the outside
    std::int64_t euler = 0;       ///< vertices - edges + faces - boxes

    /// Loops: components + cavities - euler (Euler-Poincare).
    [[nodiscard]] std::int64_t tunnels() const { return components + cavities - euler; }

    bool operator==(const VoxelTopology&) const = default;
};

/// Topology of the voxels with a value of at least `threshold`.
[[nodiscard]] VoxelTopology voxel_topology(const Image& image, double threshold);

}  // namespace vesselbench
