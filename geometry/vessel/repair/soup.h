#pragma once

#include "geometry/vessel/repair/repair_mesh.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Makes equal points one, and rim points that lie within `tolerance` [mm] of each other.
void weld(RepairMesh& mesh, double tolerance, RepairReport& report);

/// Removes triangles that name a vertex twice, and all but the first of those with the same three
/// vertices.
void remove_degenerate_and_duplicate(RepairMesh& mesh, RepairReport& report);

/// Keeps the `count` components of largest area.
/// \throw AlgorithmFailure if the largest one is only a small part of everything: scattered
///        triangles are no surface
void keep_largest_components(RepairMesh& mesh, std::size_t count, RepairReport& report);

}  // namespace vesselbench
