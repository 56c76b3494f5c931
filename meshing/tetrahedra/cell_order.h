#pragma once

#include "meshing/tetrahedra/quality.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Renumbers the tetrahedra of a mesh without prisms so that neighbours have close numbers (solvers
/// run faster and converge better); points, boundary and patches are unchanged. Source: Cuthill &
/// McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969.
/// \param neighbours receives those of the cells in their new order
[[nodiscard]] VolumeMesh in_cell_order(VolumeMesh mesh, CellNeighbours& neighbours);

}  // namespace vesselbench
