#pragma once

#include <limits>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Searches for closest points that begin near their end: they walk downhill over the edges of the
/// triangles, in constant time, where a search tree descends from its root every time. A walk stays
/// within its patch, and on its own sheet where walls almost touch.
class SurfaceWalk {
public:
    struct Place {
        Vec3 point = Vec3::Zero();                                 ///< [mm]
        Vec3 weights = {1.0, 0.0, 0.0};                            ///< barycentric, by corner [-]
        TriangleId triangle = 0;                                   ///< of the surface
        double squared = std::numeric_limits<double>::infinity();  ///< from the query [mm^2]
    };

    /// Shares the surface's arrays.
    explicit SurfaceWalk(const Surface& surface);

    /// The place on triangle t that is closest to x.
    [[nodiscard]] Place place_on(TriangleId t, const Vec3& x) const;

    /// The place where the distance from x has a minimum, downhill from triangle `from`; after 32
    /// steps the best place so far.
    [[nodiscard]] Place closest(const Vec3& x, TriangleId from) const;

private:
    [[nodiscard]] Place best_beyond(const Place& at, const Vec3& x) const;
    [[nodiscard]] Place best_around(const Place& at, int corner, const Vec3& x) const;

    [[nodiscard]] TriangleId across(TriangleId t, int edge) const { return across_[3 * t + edge]; }

    Surface surface_;
    std::vector<TriangleId> across_;  ///< 3 t + i: beyond the edge from corner i to the next one
};

}  // namespace vesselbench
