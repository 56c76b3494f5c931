#pragma once

#include <functional>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// True if every edge has exactly two triangles that traverse it in opposite directions.
[[nodiscard]] bool is_closed_manifold(const Surface& surface);

/// Volume of a closed outward surface [mm^3].
[[nodiscard]] double enclosed_volume(const Surface& surface);

/// Smallest triangle angle [deg], of the triangles whose corners are all chosen.
[[nodiscard]] double smallest_angle_deg(
    const Surface& surface,
    const std::function<bool(const Vec3&)>& chosen = [](const Vec3&) { return true; });

/// Two surfaces as one, not connected; patches of the same name and kind are merged.
[[nodiscard]] Surface merged(const Surface& a, const Surface& b);

}  // namespace vesselbench::test
