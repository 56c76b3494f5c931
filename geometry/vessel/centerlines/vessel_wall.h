#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// A vessel end visible in the surface itself: a boundary loop or a flat closure.
struct VesselEnd {
    Vec3 centre = Vec3::Zero();   ///< centroid of the opening's area [mm]
    Vec3 outward = Vec3::Zero();  ///< unit normal out of the vessel
    double radius = 0.0;          ///< of the circle of the same area [mm]
};

/// A surface decomposed for centerlines; triangles are outward, however the surface was oriented.
struct VesselWall {
    Positions points;              ///< [mm]; the surface's, then one per closed loop
    std::vector<Triangle> wall;    ///< without closures
    std::vector<Triangle> closed;  ///< wall, flat closures and fans over the loops
    std::vector<VesselEnd> ends;   ///< loops first, then flat patches, in the surface's order
    InsideRule rule = InsideRule::Winding;
    int handles = -1;     ///< of the closed surface; -1 if it is not a manifold
    double volume = 0.0;  ///< enclosed [mm^3], positive
    double area = 0.0;    ///< of the wall [mm^2]
    std::shared_ptr<const SurfaceDistance> distance;  ///< of the closed triangles
};

/// In a closed surface without labels, flat discs that close vessels are found and used as ends.
/// \throw InvalidInput if a coordinate is not finite, or there is no wall; Cancelled if the user
///        cancels
[[nodiscard]] VesselWall vessel_wall_of(const Surface& surface, const Progress& progress = {});

/// The size of the thin vessels: half the inner distance to the opposite wall [mm] such that only
/// `fraction` [-] of the wall's area is below it. Measured by about 2000 rays.
[[nodiscard]] double thin_radius(const VesselWall& wall, double fraction);

}  // namespace vesselbench
