#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Iso-surface of an image: closed, 2-manifold, outward, in patient coordinates, all pieces. Where
/// the inside reaches the image's border, it is closed flat in the plane of the outermost voxel
/// centres; the closures in one border plane are a patch of kind Cut (border_1...border_6). Grid
/// values on the iso-value (within a hundredth of the difference to their neighbours) are moved
/// away from it, so that no triangle degenerates. Source: flying_edges.h.
/// \param inside_below the inside has the values below iso, not above
/// \return an empty surface if no voxel is inside, or all of them are
/// \throw InvalidInput if an axis has fewer than two voxels; Cancelled if the user cancels
[[nodiscard]] Surface iso_surface(const Image& image, double iso, bool inside_below = false,
                                  const Progress& progress = {});

}  // namespace vesselbench
