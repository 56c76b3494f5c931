#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// A mask whose chains of voxels are whole.
struct JoinedMask {
    Image mask;
    std::size_t added = 0;  ///< voxels
};

/// Chains of a mask that touch at an edge or a corner of voxels only, as where a vessel is about a
/// voxel wide, get the voxels between: a surface between voxels separates what has no face in
/// common. A single voxel beside a vessel, and wide parts that touch, stay apart.
/// \param mask inside where >= 0.5
[[nodiscard]] JoinedMask joined_chains(const Image& mask);

/// The voxels in which a vessel is one voxel wide: they are in no square of 2 x 2 voxels inside,
/// and connect at least two parts of the mask. Offsets in the image, ascending.
[[nodiscard]] std::vector<std::size_t> chain_voxels(const Image& mask);

/// A field in which parts of a mask that are one voxel thin keep their width: the zero set of a
/// chain of voxels has at least the section of a voxel's face, and that of a sheet is a voxel
/// thick. Voxel centres keep their sides.
/// \param field above 0 inside, as from separating_field of the mask [mm]
[[nodiscard]] Image with_voxel_width(const Image& mask, const Image& field);

/// The same of some voxels of the mask only: tips of a contour are thin as well, and become spikes.
/// \param only offsets of voxels; those outside the mask do not count
[[nodiscard]] Image with_voxel_width(const Image& mask, const Image& field,
                                     std::span<const std::size_t> only);

}  // namespace vesselbench
