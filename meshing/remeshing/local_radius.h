#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Local vessel radius at every vertex [mm], #V: from the centerlines where there are some (the
/// radius at the point of the lines whose inscribed sphere is nearest), from rays across the lumen
/// otherwise. A bulge does not count: a blind branch is capped by the radius of the vessel that it
/// leaves, everything by the largest opening's radius, if there are openings. On caps: the rim's.
/// \param lines may be null
[[nodiscard]] std::vector<double> local_radii(const Surface& surface, const CenterlineGraph* lines,
                                              const Progress& progress = {});

}  // namespace vesselbench
