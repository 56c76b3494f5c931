#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/tree/tube.h"

namespace vesselbench {

/// A way through the vessels along their centerlines, from one end to another.
struct FlightPath {
    std::string name;  ///< of its end: the opening's, else "Vessel end, 3.2 mm" (its diameter)
    Tube tube;         ///< its first directions point up

    [[nodiscard]] double length() const { return tube.length(); }
};

/// A camera's place on a path.
struct FlightPlace {
    Vec3 eye = Vec3::Zero();    ///< [mm], on the centerline
    Vec3 view = Vec3::UnitY();  ///< unit, along the vessel
    Vec3 up = Vec3::UnitZ();    ///< unit, perpendicular to it
    double radius = 1.0;        ///< [mm] of the vessel
};

/// Paths from the inlet (else the widest end) to every other end, the widest first. Loops without
/// ends give a path along each branch. Of parts that are not connected, only the start's is flown.
[[nodiscard]] std::vector<FlightPath> flight_paths(const CenterlineGraph& graph,
                                                   const std::vector<PatchMeasures>& openings);

/// \param abscissa [mm], clamped to the path
/// \throw InvalidInput if the path has less than two points
[[nodiscard]] FlightPlace place_on(const FlightPath& path, double abscissa);

}  // namespace vesselbench
