#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The distance of each vertex of a surface from another surface, for colours.
struct DeviationMap {
    /// #V [mm], negative inside the other surface; not-a-number: not compared
    std::vector<double> values;
    double full = 0.0;  ///< [mm] 98 % of the compared vertices are nearer
};

/// \param compared 0 at the vertices that are not compared, #V; empty: all are
/// \throw InvalidInput if the reference has no triangle; Cancelled
[[nodiscard]] DeviationMap deviation_map(const Surface& surface, const Surface& reference,
                                         std::span<const std::uint8_t> compared = {},
                                         const Progress& progress = {});

}  // namespace vesselbench
