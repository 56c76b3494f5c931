#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The wall around one place of a branch: r(s, angle) for one s.
struct WallRing {
    double along = 0.0;             ///< arc length from the branch's start node [mm]
    Vec3 centre = Vec3::Zero();     ///< on the centerline [mm]
    Vec3 tangent = Vec3::UnitZ();   ///< unit
    Vec3 first = Vec3::UnitX();     ///< direction of angle 0, unit, across the tangent
    std::vector<double> distances;  ///< of the wall from the centre, by angle, evenly [mm];
                                    ///< infinite: no wall
    double radius = 0.0;            ///< of the circle of the section's area, bulges left out [mm]
    double aside = 0.0;             ///< share of the directions without wall, or into a bulge [-]

    /// Unit direction of the angle with this index.
    [[nodiscard]] Vec3 direction(std::size_t angle) const;

    /// Whether a narrowing, or what it is compared with, can be measured here.
    [[nodiscard]] bool is_whole() const { return radius > 0.0 && aside <= 0.25; }
};

/// The rings of a branch where it is a vessel by itself: beyond the furcations' zones (see
/// furcation_zone_end), and one radius from its tips; a fifth of the branch's median radius apart.
/// Empty where nothing is left.
/// \param surface whose centerlines these are
/// \throw Cancelled
[[nodiscard]] std::vector<WallRing> wall_rings(const Surface& surface, const CenterlineGraph& graph,
                                               std::size_t branch, const Progress& progress = {});

}  // namespace vesselbench
