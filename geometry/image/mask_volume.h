#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Volume that the voxels of a mask say [mm^3]. The image ends at the outermost voxel centres: of a
/// voxel there, half lies within for each border it is at.
/// \param mask inside where >= 0.5
[[nodiscard]] double volume_of_voxels(const Image& mask);

/// Area of the wall [mm^2], without the closures at the image's border.
[[nodiscard]] double wall_area(const Surface& surface);

}  // namespace vesselbench
