#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// Whether a mask's voxel is inside.
[[nodiscard]] inline bool is_inside(float value) {
    return value >= 0.5f;
}

/// The voxels around a mask's outline, and who neighbours whom. Layer 1 has a face in common with a
/// voxel of the other side; layer n + 1 touches layer n at a face, an edge or a corner.
struct VoxelBand {
    static constexpr std::int32_t kNone = -1;
    static constexpr std::size_t kNeighbours = 12;

    std::vector<std::size_t> voxels;   ///< offsets in the image, ascending
    std::vector<std::uint8_t> inside;  ///< 1 or 0
    std::vector<std::uint8_t> layer;   ///< 1 to the number of layers
    /// Places in `voxels` of the neighbours at +i, -i, +j, -j, +k, -k, then at +i+j, -i-j, +i+k,
    /// -i-k, +j+k, -j-k; kNone outside the band.
    std::vector<std::array<std::int32_t, kNeighbours>> neighbours;
    /// [mm] to the nearest voxel centre of layer 1 on the own side
    std::vector<float> depth;

    [[nodiscard]] std::size_t size() const { return voxels.size(); }
};

/// All voxels around one, by its number in the band, on its own side belong to the outline as well.
[[nodiscard]] bool is_thin(const VoxelBand& band, std::size_t voxel);

/// \param layers on each side of the outline, 1 to 8
/// \throw InvalidInput if layers is out of range, or the band has 2^31 voxels or more
[[nodiscard]] VoxelBand voxel_band(const Image& mask, int layers);

}  // namespace vesselbench
