#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Local vessel radius at every vertex [mm], #V: from the centerlines if there are any (the radius
/// at the point of the lines with the nearest inscribed sphere), else from rays across the lumen.
/// Bulges do not count: a blind branch is limited by its parent's radius, everything by the largest
/// opening's radius, if there are openings. On caps: the rim's.
/// \param lines may be null
[[nodiscard]] std::vector<double> local_radii(const Surface& surface, const CenterlineGraph* lines,
                                              const Progress& progress = {});

}  // namespace vesselbench
