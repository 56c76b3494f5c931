#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "gpu/render/view_camera.h"

namespace vesselbench {

/// A sphere of a given centre that contains all points.
[[nodiscard]] inline Sphere sphere_around(std::span<const Vec3> points, const Vec3& centre) {
    double squared = 0.0;
    for (const Vec3& p : points) squared = std::max(squared, (p - centre).squaredNorm());
    return {centre, std::sqrt(squared)};
}

/// Around the middle of their box.
[[nodiscard]] inline Sphere sphere_around(const Positions& points) {
    return sphere_around(points, bounds(points).centre());
}

}  // namespace vesselbench
