#pragma once

#include <memory>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Signed mean curvature [1/mm] per vertex, +1/r on an outward sphere of radius r; 0 on open rims.
/// Source: Meyer, Desbrun, Schroeder and Barr, "Discrete differential-geometry operators for
/// triangulated 2-manifolds", 2003, Eqs. 7 and 8 (mixed areas).
struct MeanCurvature {
    std::vector<double> values;  ///< H [1/mm], #V
    std::vector<double> areas;   ///< mixed area [mm^2], #V
};

[[nodiscard]] MeanCurvature mean_curvature(const Surface& surface);

/// The same, computed once per shape (derived_cache.h).
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] std::shared_ptr<const MeanCurvature> mean_curvature_of(
    const Surface& surface, DerivedCache& cache = derived_cache());

}  // namespace vesselbench
