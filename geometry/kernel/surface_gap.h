#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Where two surfaces are nearest to each other.
struct SurfaceGap {
    Vec3 from = Vec3::Zero();  ///< on the first surface [mm]
    Vec3 to = Vec3::Zero();    ///< on the second one [mm]
    double distance = 0.0;     ///< between the two [mm]; 0: they touch or cross
};

/// The smallest distance between the triangles of two surfaces: exact, also between edges and where
/// they cross. Of one surface inside another one it is the distance to the other's wall.
/// \throw InvalidInput if one of them has no triangle
[[nodiscard]] SurfaceGap smallest_gap(const Surface& first, const Surface& second);

/// The nearest points of the segments a0 a1 and b0 b1.
/// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
[[nodiscard]] SurfaceGap segment_gap(const Vec3& a0, const Vec3& a1, const Vec3& b0,
                                     const Vec3& b1);

}  // namespace vesselbench
