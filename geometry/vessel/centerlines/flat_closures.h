#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

class SurfaceDistance;

/// Flat discs that close the ends of vessels in a surface without labels (a capped model, a vessel
/// cut at an image's border): planar, round, bounded by a sharp rim, and as wide as the lumen
/// behind them.
/// \param points [mm]
/// \param triangles outward, closed
/// \param surface the same triangles, for distances
/// \return per disc its triangles' indices, ascending; by first triangle
[[nodiscard]] std::vector<std::vector<TriangleId>> find_flat_closures(
    const Positions& points, std::span<const Triangle> triangles, const SurfaceDistance& surface);

}  // namespace vesselbench
