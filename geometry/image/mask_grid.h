#pragma once

#include "geometry/image/image.h"

namespace vesselbench {

/// How a mask's grid lies to that of its image.
enum class MaskGrid {
    Same,      ///< the same voxels
    Lattice,   ///< the same lattice: a part of the grid, or its axes in another order or direction
    Resampled  ///< another lattice: the mask was resampled by shape
};

/// A mask on its image's grid.
struct PlacedMask {
    Image mask;
    MaskGrid grid = MaskGrid::Same;
    double beyond = 0.0;  ///< [-] of its inside that lies beyond the image and is lost
};

/// Brings a mask of labels to the image's grid. On the same lattice, within a tenth of a voxel, its
/// voxels keep their values, and those that it lacks are outside. Elsewhere a voxel gets the label
/// in which its centre is deepest by the signed distance to the label's outline, interpolated
/// linearly; a label keeps its volume.
/// Source: Raya, Udupa, "Shape-based interpolation of multidimensional objects", IEEE Trans.
/// Medical Imaging 1990.
/// \throw InvalidInput if nothing of the mask's inside lies in the image
[[nodiscard]] PlacedMask mask_on_grid(const Image& image, const Image& mask);

}  // namespace vesselbench
