#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The wall of a vessel that somebody drew as a mask, refined by the image.
struct DrawnWall {
    Image mask_field;   ///< of the mask's smooth surface
    Image field;        ///< the same with its zero set moved to the image's edges
    double seen = 0.0;  ///< [-] of the wall that has an edge of the image within a voxel
};

/// Moves the smooth surface of a mask to the edge that the image shows along its normal, by at most
/// a voxel's length in that direction: where the intensities pass the middle of the levels inside
/// and outside nearby, corrected for what blur does to a curved wall. Where there is no such edge
/// the surface stays, as far as its surroundings let it: the offsets are those that fit the edges,
/// by their steepness over the noise, change least along the wall, and are small. The vessel may be
/// brighter or darker than what is around it, and that may differ from place to place. The topology
/// of the mask is kept.
/// Source of the correction: Verbeek, van Vliet, "On the location error of curved edges in low-pass
/// filtered 2-D and 3-D images", IEEE PAMI 1994.
/// \param image,mask on the same grid; the mask is inside where >= 0.5
/// \param smooth of the mask: separating_field(), or curved_field() on its finer grid, where the
///        offsets found in the slices are linear between them
/// \throw InvalidInput as separating_field(); Cancelled if the user cancels
[[nodiscard]] DrawnWall drawn_wall(const Image& image, const Image& mask, const Image& smooth,
                                   const Progress& progress = {});

}  // namespace vesselbench
