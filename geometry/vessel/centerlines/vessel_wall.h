#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// An end of a vessel that the surface itself shows: a boundary loop or a flat closure.
struct VesselEnd {
    Vec3 centre = Vec3::Zero();   ///< centroid of the opening's area [mm]
    Vec3 outward = Vec3::Zero();  ///< unit normal out of the vessel
    double radius = 0.0;          ///< of the circle of the same area [mm]
};

/// A surface taken apart for centerlines; triangles are outward, whatever the surface was.
struct VesselWall {
    Positions points;              ///< [mm]; the surface's, then one per closed loop
    std::vector<Triangle> wall;    ///< without closures
    std::vector<Triangle> closed;  ///< wall, flat closures and fans over the loops
    std::vector<VesselEnd> ends;   ///< loops first, then flat patches, in the surface's order
    InsideRule rule = InsideRule::Winding;
    int handles = -1;     ///< of the closed surface; -1 when it is no manifold
    double volume = 0.0;  ///< enclosed [mm^3], positive
    double area = 0.0;    ///< of the wall [mm^2]
    std::shared_ptr<const SurfaceDistance> distance;  ///< of the closed triangles
};

/// Of a closed surface without labels, flat discs that close vessels are found and taken as ends.
/// \throw InvalidInput if a coordinate is not finite, or there is no wall
[[nodiscard]] VesselWall vessel_wall_of(const Surface& surface);

/// Half the inner distance to the opposite wall [mm] that only `fraction` [-] of the wall's area
/// undercuts: the size of the thin vessels. Measured by about 2000 rays.
[[nodiscard]] double thin_radius(const VesselWall& wall, double fraction);

}  // namespace vesselbench
