#pragma once

#include <cmath>
#include <numbers>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Angle between two directions [deg], from 0 to 180.
[[nodiscard]] inline double angle_deg(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

}  // namespace vesselbench
