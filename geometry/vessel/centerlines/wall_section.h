#pragma once

#include <vector>

#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/vessel_wall.h"

namespace vesselbench {

/// A point of a line being moved to the middle of its vessel.
struct LinePlace {
    Vec3 point = Vec3::Zero();      ///< [mm]
    Vec3 tangent = Vec3::UnitZ();   ///< unit
    Vec3 curvature = Vec3::Zero();  ///< second derivative by arc length [1/mm]
    double radius = 0.0;            ///< estimate of the vessel's radius here [mm]
};

/// The largest circle in the vessel's section at a point.
struct WallSection {
    Vec3 centre = Vec3::Zero();  ///< [mm], in the plane through the point
    double radius = 0.0;         ///< [mm]
    double covered = 0.0;        ///< fraction of the directions in which there is wall [-]
};

/// The wall as points with normals, for section queries.
class WallSections {
public:
    /// \param finest upper bound of the sample distance on a triangle [mm], within reason
    WallSections(const VesselWall& wall, double finest);

    /// The section at a point: wall samples in a slab around the perpendicular plane are projected
    /// along the (curved) line and averaged over 24 sectors; the largest circle is fitted to the
    /// result with a soft minimum, which averages noise, too.
    /// \param softness [-] of the minimum in radii: large averages, small is exact
    [[nodiscard]] WallSection at(const LinePlace& place, double softness) const;

    /// True distance [mm] from p to the wall's triangles (without closures).
    [[nodiscard]] double distance(const Vec3& p) const {
        return distance_.closest_point(p).distance;
    }

    /// Distance [mm] to wall or closure along a ray; infinite if it leaves the vessel.
    [[nodiscard]] double free_way(const Vec3& from, const Vec3& direction) const;

private:
    struct Sample {
        Vec3 point, normal;
        double area = 0.0;
    };

    BoxTree tree_;
    std::vector<Sample> samples_;
    SurfaceDistance distance_;
    SurfaceDistance closed_;
};

}  // namespace vesselbench
