#pragma once

#include <vector>

#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// The points' numbers along a curve that fills space (Morton's): what is near in space is near in
/// this order, and a range of it is a region. Does not depend on the number of threads.
/// Source: Morton, "A computer oriented geodetic data base", IBM 1966.
[[nodiscard]] std::vector<VertexId> space_order(const Positions& points);

/// The mesh with its points in that order, and its cells in that of their lowest point.
/// \param order receives the former number of each point
[[nodiscard]] VolumeMesh in_space_order(const VolumeMesh& mesh, std::vector<VertexId>& order);

}  // namespace vesselbench
