#pragma once

#include <optional>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A vessel's turn at a place.
struct Bend {
    Vec3 place = Vec3::Zero();  ///< on the centerline [mm]
    double turn_deg = 0.0;      ///< between the vessel's courses over one diameter before and after
    double radius = 0.0;        ///< of the vessel there [mm]
};

/// The strongest bend within a branch, from furcation to furcation; a bend of radius R of a vessel
/// of radius r turns by about 2 r / R. None if every branch is shorter than two diameters.
[[nodiscard]] std::optional<Bend> strongest_bend(const CenterlineGraph& graph);

}  // namespace vesselbench
