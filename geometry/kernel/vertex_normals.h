#pragma once

#include <memory>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Unit vertex normals, mean of the triangle normals weighted by the angle at the vertex; zero
/// where that is undefined. Source: Thuermer and Wuethrich, "Computing vertex normals from
/// polygonal facets", 1998.
[[nodiscard]] Positions vertex_normals(const Surface& surface);

/// The same, computed once per shape (derived_cache.h).
[[nodiscard]] std::shared_ptr<const Positions> vertex_normals_of(
    const Surface& surface, DerivedCache& cache = derived_cache());

/// Per vertex the largest angle [deg] between the vertex normal and the normals of its triangles
/// (thesis 5.4.1).
[[nodiscard]] std::vector<double> normal_curvature(const Surface& surface,
                                                   DerivedCache& cache = derived_cache());

}  // namespace vesselbench
