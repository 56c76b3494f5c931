#pragma once

#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A line of the view that belongs to a form.
struct RegionLine {
    Positions points;  ///< [mm]
    bool closed = false;
    bool faint = false;     ///< offered, not chosen
    bool in_front = false;  ///< lies on the surface: drawn over it

    bool operator==(const RegionLine&) const = default;
};

/// The edges of a box.
[[nodiscard]] std::vector<RegionLine> box_lines(const Vec3& low, const Vec3& high);

/// Three great circles of a ball.
[[nodiscard]] std::vector<RegionLine> ball_lines(const Vec3& centre, double radius);

/// Points of a circle around a unit normal, evenly, the last one before the first.
[[nodiscard]] Positions circle_points(const Vec3& centre, const Vec3& normal, double radius,
                                      int count);

/// A circle around a unit normal.
[[nodiscard]] RegionLine circle_line(const Vec3& centre, const Vec3& normal, double radius);

}  // namespace vesselbench
