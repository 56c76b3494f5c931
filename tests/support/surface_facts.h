#pragma once

#include <functional>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// Every edge has exactly two triangles, which run against each other.
[[nodiscard]] bool is_closed_manifold(const Surface& surface);

/// Volume of a closed outward surface [mm^3].
[[nodiscard]] double enclosed_volume(const Surface& surface);

/// Smallest triangle angle [deg], of the triangles all of whose corners are chosen.
[[nodiscard]] double smallest_angle_deg(
    const Surface& surface,
    const std::function<bool(const Vec3&)>& chosen = [](const Vec3&) { return true; });

/// Two surfaces side by side in one; patches of the same name and kind become one.
[[nodiscard]] Surface merged(const Surface& a, const Surface& b);

}  // namespace vesselbench::test
