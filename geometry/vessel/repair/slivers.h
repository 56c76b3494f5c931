#pragma once

#include "geometry/vessel/repair/repair_mesh.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Removes edges and triangle heights below `smallest` [mm] from a manifold: short edges collapse
/// into one of their ends (rims and patch borders stay where they are), flat caps swap their
/// longest edge. Nothing moves farther than `smallest` at a time. What cannot go without spoiling
/// the manifold stays.
/// \return true if something changed
bool remove_slivers(RepairMesh& mesh, double smallest, RepairReport& report);

}  // namespace vesselbench
