#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/vec3.h"

namespace vesselbench {

/// Largest of (t - 60) / 120 and (60 - t) / 60 over the angles t [deg]: 0 for an equilateral
/// triangle, 1 for a degenerate one.
[[nodiscard]] inline double equiangle_skewness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double twice_area = (b - a).cross(c - a).norm();
    const auto angle = [&](const Vec3& at, const Vec3& p, const Vec3& q) {
        return std::atan2(twice_area, (p - at).dot(q - at));
    };
    const double third = std::numbers::pi / 3.0;
    double skewness = 0.0;
    for (const double t : {angle(a, b, c), angle(b, c, a), angle(c, a, b)})
        skewness = std::max({skewness, (t - third) / (2.0 * third), (third - t) / third});
    return skewness;
}

/// 2 r_in / r_out: 1 for an equilateral triangle, 0 for a degenerate one.
[[nodiscard]] inline double radius_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = (b - c).norm(), y = (c - a).norm(), z = (a - b).norm();
    const double twice_area = (b - a).cross(c - a).norm(), product = (x + y + z) * x * y * z;
    return product > 0.0 ? 4.0 * twice_area * twice_area / product : 0.0;
}

}  // namespace vesselbench
