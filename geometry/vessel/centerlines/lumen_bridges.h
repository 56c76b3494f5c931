#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// Joins parts of the lumen that are apart on the grid only, because the vessel between them is
/// thinner than the grid resolves: by paths of voxels between neighbours of which no wall lies. The
/// voxels of a path may be nearer to the wall than others (voxelise), but not beside a voxel beyond
/// it.
/// \param wall the closed triangles that were voxelised
/// \throw Cancelled if the user cancels
void bridge_parts(LumenGrid& grid, const SurfaceDistance& wall, const Progress& cancel);

}  // namespace vesselbench
