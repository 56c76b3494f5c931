#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Removes edges and triangle heights below `smallest_feature` [mean edges] from a manifold: short
/// edges collapse into one of their ends (rims and patch borders stay where they are), flat caps
/// swap their longest edge. No step moves a vertex farther than that. Slivers stay if removing them
/// would break the manifold.
void remove_slivers(TriangleSoup& soup, double smallest_feature, RepairReport& report);

}  // namespace vesselbench
