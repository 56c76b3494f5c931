#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

class SurfaceDistance;

/// Flat discs of a surface without labels, each by its triangles' indices, ascending.
struct FlatDiscs {
    /// They close the ends of vessels (a capped model, a vessel cut at an image's border): round,
    /// bounded by a sharp and flat rim, and as wide as the lumen behind them; inside the rim they
    /// are planar, or dented by up to half a radius.
    std::vector<std::vector<TriangleId>> closures;
    /// They close the mouths of something wider beside such vessels, as a valve's of a heart's
    /// chamber: the same, planar or dented, but narrower than the lumen, and not much smaller than
    /// the smallest closure.
    std::vector<std::vector<TriangleId>> mouths;
};

/// \param points [mm]
/// \param triangles outward, closed
/// \param surface the same triangles, for distances
[[nodiscard]] FlatDiscs find_flat_closures(const Positions& points,
                                           std::span<const Triangle> triangles,
                                           const SurfaceDistance& surface);

}  // namespace vesselbench
