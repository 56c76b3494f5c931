#pragma once

#include <cstddef>

#include "geometry/image/image.h"

namespace vesselbench {

/// Where a mask with grazes gets voxels.
enum class FreedSides {
    All,     ///< around the whole mask: ends that other sides cut become a voxel longer
    Touched  ///< beyond the sides that a wall touches; the others stay where they are
};

/// A mask whose walls end only where its image's border has cut a vessel.
struct FreedMask {
    Image mask;
    std::size_t grazes = 0;  ///< places where a wall touched a side of the image
};

/// Where a vessel's wall touches the border of an image, as at the bends of a segment that was
/// cropped to its own box, no vessel ends: there the mask gets a voxel outside. Where the same
/// side has cut a vessel, the mask goes on for that voxel. A wall that touches a side spreads
/// behind it; a vessel that crosses it keeps its section. A mask without such places stays as it
/// is. \param mask inside where >= 0.5
[[nodiscard]] FreedMask without_grazes(const Image& mask, FreedSides sides);

}  // namespace vesselbench
