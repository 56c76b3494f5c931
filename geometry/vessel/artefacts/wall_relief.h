#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// How far a vessel's wall lies off the smooth tube around it.
struct WallRelief {
    /// Outward from the tube [radii], #V; not-a-number in furcations, at ends, and where too few
    /// vertices lie around the line.
    std::vector<double> heights;
    std::vector<double> radii;    ///< of the tube there [mm], #V; 0 where it is not known
    std::vector<double> scatter;  ///< robust standard deviation of the heights around [radii], #V
};

/// Fits a tube to each stretch of 2.5 radii of a vessel: its distance from the line is a constant,
/// an offset and an ellipse around the line, of which the first two may change along it. Vertices
/// far off count less (TubeFit), so that a bump of up to a fifth of the stretch's wall does not
/// draw the tube towards it. \param graph centerlines of the surface \throw Cancelled
[[nodiscard]] WallRelief wall_relief(const Surface& surface, const CenterlineGraph& graph,
                                     const Progress& progress = {});

/// A spot of the wall that lies off its tube, all to one side.
struct WallSpot {
    Vec3 place = Vec3::Zero();  ///< the vertex farthest off [mm]
    double height = 0.0;        ///< there, outward [mm]; negative: a dent
    double size = 0.0;          ///< radius of the circle of the spot's area [mm]
    double radius = 0.0;        ///< of the vessel there [mm]
    double scatter = 0.0;       ///< of the wall around [mm], one standard deviation
};

/// Spots that lie off by more than 6 % of the radius and 2.5 standard deviations, those that are
/// farthest off beside what the wall scatters first; none wider than the vessel, which is a part of
/// its shape.
[[nodiscard]] std::vector<WallSpot> wall_spots(const Surface& surface, const WallRelief& relief);

}  // namespace vesselbench
