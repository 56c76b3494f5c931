#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

using TrianglePair = std::pair<TriangleId, TriangleId>;

/// Pairs (low, high) of triangles that meet elsewhere than in their shared vertices and edges,
/// ascending; decided exactly. Triangles without area are ignored. Works on any triangles, even
/// non-manifold ones; parallel, the same result for any number of threads.
[[nodiscard]] std::vector<TrianglePair> self_intersections(const Positions& positions,
                                                           std::span<const Triangle> triangles,
                                                           const Progress& progress = {});

/// The same pairs, but only those that contain a chosen triangle: for when only a few moved.
/// \param chosen 1 at the triangles, #T
/// \throw InvalidInput unless chosen is #T long
[[nodiscard]] std::vector<TrianglePair> self_intersections_with(
    const Positions& positions, std::span<const Triangle> triangles,
    std::span<const std::uint8_t> chosen, const Progress& progress = {});

/// The same pairs of a whole surface, searched once per shape (derived_cache.h).
[[nodiscard]] std::vector<TrianglePair> self_intersections(const Surface& surface,
                                                           const Progress& progress = {},
                                                           DerivedCache& cache = derived_cache());

/// Records that a shape has no self-intersections, so that it is not searched again.
void remember_no_self_intersections(const Topology& topology, const Positions& positions,
                                    DerivedCache& cache = derived_cache());

}  // namespace vesselbench
