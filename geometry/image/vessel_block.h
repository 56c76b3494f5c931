#pragma once

#include <array>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/image/vessel_body.h"
#include "geometry/image/voxels.h"

namespace vesselbench {

/// A box of voxels.
struct VoxelBlock {
    std::array<int, 3> from = {0, 0, 0}, size = {0, 0, 0};

    [[nodiscard]] std::size_t voxel_count() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]);
    }
};

/// The block that holds a box and some voxels around it, as far as the image has them; of an empty
/// box the whole image.
[[nodiscard]] VoxelBlock block_around(const Image& image, const VoxelBox& box, int margin);

/// The block that holds a vessel and what a blur of it reaches.
/// \throw AlgorithmFailure if no voxel has at least the threshold
[[nodiscard]] VoxelBlock block_around_vessel(const Image& image, double threshold,
                                             const VesselBody& body);

/// The image in a block.
[[nodiscard]] Image part_of(const Image& image, const VoxelBlock& block);

/// The image with other values in a block.
/// \param values of the block's voxels
[[nodiscard]] Image with_part(const Image& image, const VoxelBlock& block,
                              const std::vector<float>& values);

/// An image of one value outside a block, and of others in it.
/// \param values of the block's voxels
[[nodiscard]] Image with_part(const Image& grid, const VoxelBlock& block,
                              const std::vector<float>& values, float outside);

/// By voxel: 1 in the vessel at a threshold and within some voxels of it, else 0.
/// \throw AlgorithmFailure if no voxel has at least the threshold
[[nodiscard]] std::vector<float> around_vessel(const Image& image, double threshold,
                                               const VesselBody& body, int voxels);

/// Of a field that is at least 0 inside, every other body than the vessel becomes outside.
/// \throw AlgorithmFailure if nothing is inside
void keep_vessel(const Image& grid, const VesselBody& body, std::vector<float>& inside);

/// The voxels in which a vessel that a threshold shows in one piece is broken by another inside.
/// \param inside at least 0 inside \return offsets of voxels that connect two pieces of it
[[nodiscard]] std::vector<std::size_t> voxels_of_gaps(const Image& image, double threshold,
                                                      const VesselBody& body,
                                                      const std::vector<float>& inside);

}  // namespace vesselbench
