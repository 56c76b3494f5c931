#include "workbench/operations/shared/stated_changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr double kEdges = 3.0;  ///< staircases and noise are lower [edges]
constexpr double kRadii = 0.8;  ///< a sac's dome lies farther from what is left of it [radii]

/// Edge of equal triangles of the same area [mm].
double typical_edge(const Surface& surface) {
    const double each = area(surface) / static_cast<double>(surface.triangle_count());
    return std::sqrt(4.0 / std::numbers::sqrt3 * each);
}

}  // namespace

StatedChange kept_vessels_and_sacs(const Scene& before, const Outcome& outcome) {
    StatedChange stated = kept_vessels(before, outcome);
    add_kept_wall(stated, before, outcome);
    return stated;
}

void add_kept_wall(StatedChange& stated, const Scene& before, const Outcome& outcome) {
    if (!before.surface || !outcome.scene.surface || before.surface->empty() ||
        outcome.scene.surface->empty())
        return;
    stated.wall_lost =
        kEdges * std::max(typical_edge(*before.surface), typical_edge(*outcome.scene.surface));
    stated.radii_lost = kRadii;
}

}  // namespace vesselbench
