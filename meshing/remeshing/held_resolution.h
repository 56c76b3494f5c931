#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The largest distance between a surface and what was made of it.
struct LargestDeviation {
    double distance = 0.0;      ///< [mm]
    Vec3 place = Vec3::Zero();  ///< on the source [mm]
};

/// Shortens the target edges of the source where the result is off by more than the resolution,
/// down to edges as long as it: shorter ones bring nothing.
/// Compared are the vertices of the source with the result, and the centres of the result's
/// triangles with the source; the result's vertices lie on the source.
/// \param resolution [mm], > 0
/// \param sizes target edges [mm], #V of the source; not limited in their slope afterwards
/// \return the deviation that was found. \throw Cancelled
[[nodiscard]] LargestDeviation refine_where_off(const Surface& source, const Surface& result,
                                                double resolution, std::vector<double>& sizes,
                                                const Progress& cancel);

}  // namespace vesselbench
