#pragma once

#include <ctime>

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

// Remeshing by another library, as a reference for ours.

struct RemeshingRun {
    Surface surface;
    double seconds = 0.0;    ///< without conversions
    double processor = 0.0;  ///< time of all processors [s]
};

/// Since `start`, of all processors [s]: hardly changes where other programs run too.
[[nodiscard]] inline double processor_seconds(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// CGAL's isotropic remeshing of every patch to one edge length [mm], rims kept as features.
/// Source: CGAL 5.5 Polygon Mesh Processing, after Botsch & Kobbelt 2004.
/// \throw InvalidInput if the surface is not an oriented manifold
[[nodiscard]] RemeshingRun cgal_isotropic(const Surface& surface, double edge);

}  // namespace vesselbench::bench
