#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

/// Raw marching-cubes surface of an organ-like shape: an ellipsoid of 60 x 48 x 39 mm half-axes
/// with lobes, as an image of 16 grey levels at its wall gives it (slivers and steps, unsmoothed).
/// \param vertices about how many vertices it gets, to a few per cent; the image that is made on
///        the way takes 4 bytes a voxel (40 MB for 250,000 vertices, 10 GB for 7 million)
/// \param slice voxels along z that belong to one slice of the image stack: above 1 every slice
///        repeats the same voxels, and the surface gets staircases along z
[[nodiscard]] Surface organ(double vertices, int slice = 1);

}  // namespace vesselbench::bench
