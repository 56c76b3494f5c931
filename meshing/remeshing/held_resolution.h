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

/// How far a result is off its source.
struct Deviations {
    std::vector<double> at;  ///< #V of the source: the largest that concerns the vertex [mm]
    LargestDeviation largest;
};

/// Compares the vertices of the source with the result, and the centres of the result's triangles
/// with the source; the result's vertices are taken to lie on the source.
/// \throw Cancelled
[[nodiscard]] Deviations deviations_from(const Surface& source, const Surface& result,
                                         const Progress& cancel);

/// Shortens the target edges of the source where the result is off by more than the resolution,
/// down to edges as long as it: shorter ones bring nothing.
/// \param resolution [mm], > 0
/// \param sizes target edges [mm], #V of the source; not limited in their slope afterwards
void shorten_where_off(const Deviations& deviations, double resolution, std::vector<double>& sizes);

}  // namespace vesselbench
