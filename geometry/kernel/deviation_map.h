#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The distance of each vertex of a surface from another surface, for colours.
struct DeviationMap {
    std::vector<double> values;  ///< #V [mm], negative inside the other surface
    double full = 0.0;           ///< [mm] 98 % of the vertices are nearer
};

/// \throw InvalidInput if the reference has no triangle; Cancelled
[[nodiscard]] DeviationMap deviation_map(const Surface& surface, const Surface& reference,
                                         const Progress& progress = {});

}  // namespace vesselbench
