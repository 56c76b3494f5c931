#pragma once

#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// The mesh with its points in space_order, and its cells in that of their lowest point.
[[nodiscard]] VolumeMesh in_space_order(const VolumeMesh& mesh);

}  // namespace vesselbench
