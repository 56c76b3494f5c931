#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

/// Raw marching-cubes surface of an organ-like shape: an ellipsoid of 60 x 48 x 39 mm half-axes
/// with lobes, as extracted from an image with 16 grey levels across its wall (slivers and steps,
/// unsmoothed).
/// \param vertices their number, met to a few per cent; the intermediate image takes 4 bytes per
///        voxel (40 MB for 250,000 vertices, 10 GB for 7 million)
/// \param slice voxels along z in one slice of the image stack: above 1, each slice repeats its
///        voxels, and the surface has staircases along z
[[nodiscard]] Surface organ(double vertices, int slice = 1);

}  // namespace vesselbench::bench
