#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/spread.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Mean of its corners.
[[nodiscard]] inline Vec3 triangle_centre(const Positions& points, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return (points[a] + points[b] + points[c]) / 3.0;
}

/// Largest of (t - 60) / 120 and (60 - t) / 60 over the angles t [deg]: 0 for an equilateral
/// triangle, 1 for a degenerate one.
[[nodiscard]] inline double equiangle_skewness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double twice_area = ab.cross(ca).norm(), third = std::numbers::pi / 3.0;
    const double x = bc.squaredNorm(), y = ca.squaredNorm(), z = ab.squaredNorm();
    // The angle opposite to an edge, by the law of cosines: the largest one is opposite to the
    // longest edge.
    const auto opposite = [&](double edge) {
        return std::atan2(2.0 * twice_area, x + y + z - 2.0 * edge);
    };
    const double largest = opposite(std::max({x, y, z})), least = opposite(std::min({x, y, z}));
    return std::max((largest - third) / (2.0 * third), (third - least) / third);
}

/// 2 r_in / r_out: 1 for an equilateral triangle, 0 for a degenerate one.
[[nodiscard]] inline double radius_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = (b - c).norm(), y = (c - a).norm(), z = (a - b).norm();
    const double twice_area = (b - a).cross(c - a).norm(), product = (x + y + z) * x * y * z;
    return product > 0.0 ? 4.0 * twice_area * twice_area / product : 0.0;
}

/// Area by the squares of the edges: 1 for an equilateral triangle, 0 for a degenerate one.
[[nodiscard]] inline double edge_area_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double squares = (a - b).squaredNorm() + (b - c).squaredNorm() + (c - a).squaredNorm();
    const double twice_area = (b - a).cross(c - a).norm();
    return squares > 0.0 ? 2.0 * std::numbers::sqrt3 * twice_area / squares : 0.0;
}

/// Shape of several triangles; zeros without any.
struct TriangleShape {
    Spread equiangle_skewness;  ///< [-]
    Spread radius_ratio;        ///< [-], at most 1
};

/// Of all triangles of a surface, of its wall's, of those of caps and other openings.
[[nodiscard]] TriangleShape triangle_shape(const Surface& surface);
[[nodiscard]] TriangleShape wall_shape(const Surface& surface);
[[nodiscard]] TriangleShape openings_shape(const Surface& surface);

}  // namespace vesselbench
