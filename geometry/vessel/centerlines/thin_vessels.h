#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/lumen_grid.h"
#include "geometry/vessel/centerlines/vessel_wall.h"

namespace vesselbench {

/// Adds what the grid does not show of a vessel that is thinner than its voxels: paths of voxels
/// along the middle of stretches of wall that no voxel of the lumen is near. They lead to the far
/// end of a stretch, if the vessel ends there, or join parts of the lumen that are apart on the
/// grid only. A path ends early where it would make voxels neighbours between which a wall lies.
/// \throw Cancelled if the user cancels
void add_thin_vessels(LumenGrid& grid, const VesselWall& wall, const Progress& cancel);

}  // namespace vesselbench
