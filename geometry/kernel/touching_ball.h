#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Radius [mm] of the largest ball inside a wall that touches it at `at`, with its centre on the
/// inward normal. What is seen from the centre within 30 degrees of the place is the place's own
/// neighbourhood and does not count.
/// Source: Ma, Bae, Choi, "3D medial axis point approximation using nearest neighbors and the
/// normal field", The Visual Computer 28, 2012.
/// \param inward of length 1
/// \param radius of a ball that is not smaller, such as half the way across [mm]
/// \param nearest (centre, reach) -> std::optional<Vec3>: the place on the wall nearest to the
/// centre, if it is closer than `reach` [mm]
template <class Nearest>
[[nodiscard]] double touching_ball(const Vec3& at, const Vec3& inward, double radius,
                                   const Nearest& nearest) {
    constexpr int kMostShrinkings = 40;  // a dozen suffice on vessels
    constexpr double kShrinks = 1e-3;    // less is the same ball [-]
    static const double kOwn = std::cos(std::numbers::pi / 6.0);
    for (int step = 0; step < kMostShrinkings; ++step) {
        const Vec3 centre = at + radius * inward;
        const std::optional<Vec3> place = nearest(centre, radius * (1.0 - kShrinks));
        if (!place) break;
        const Vec3 there = *place - at;
        const double height = inward.dot(there);
        if (height <= 0.0) break;
        const Vec3 seen = *place - centre;
        if (-inward.dot(seen) > kOwn * seen.norm()) break;
        // The ball through both, tangential at `at`.
        radius = std::min(radius, there.squaredNorm() / (2.0 * height));
    }
    return radius;
}

}  // namespace vesselbench
