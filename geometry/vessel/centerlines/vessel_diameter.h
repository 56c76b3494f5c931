#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Length of a polyline [mm]; 0 for less than two points.
[[nodiscard]] double path_length(std::span<const Vec3> points);

/// The size of a vessel at a place.
struct VesselDiameter {
    Vec3 centre = Vec3::Zero();  ///< on the centerline [mm]
    double inscribed = 0.0;      ///< diameter of the largest sphere inside the vessel there [mm]
    Positions outline;           ///< of the perpendicular section; empty: there is none
    double area = 0.0;           ///< of the section [mm^2]
    double equivalent = 0.0;     ///< diameter of the circle of that area [mm]
};

/// The diameter at the centerline's place that is nearest to a point of the wall; none without
/// lines. \param surface whose centerlines these are
[[nodiscard]] std::optional<VesselDiameter> vessel_diameter(const Surface& surface,
                                                            const CenterlineGraph& graph,
                                                            const Vec3& point);

}  // namespace vesselbench
