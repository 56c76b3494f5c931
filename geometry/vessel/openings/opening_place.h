#pragma once

#include <functional>
#include <optional>
#include <string>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Where a branch is cut.
struct OpeningPlace {
    Vec3 tip = Vec3::Zero();  ///< the branch's tip on the centerline [mm]
    Plane plane;              ///< through the section's centroid; normal out of the vessel
    double distance = 0.0;    ///< from the tip along the centerline [mm]
    double share = 0.0;  ///< fraction of the branch's length given up, if the distance was chosen
                         ///< automatically
    double diameter = 0.0;   ///< of the circle with the section's area [mm]
    double tilt_deg = 0.0;   ///< remaining angle between the plane's normal and the vessel's axis
    double bend_deg = 0.0;   ///< turn of the vessel over one diameter inward
    double doubt_deg = 0.0;  ///< standard deviation of the axis, of which the normal has its own
    bool measured = false;   ///< an axis was found inside: tilt and bend are known; otherwise the
                             ///< normal is the centerline's direction
};

/// A vessel that turns by more than this over one diameter counts as a bend [deg].
inline constexpr double kBendDeg = 15.0;

/// Chooses the plane at which a branch is opened, perpendicular to the vessel's axis just inside
/// (axis_inward, iterated until the normal is that axis; then axis_by_wall). Without a distance:
/// the first whole section from the tip, never beyond the furcation; a straighter one behind it is
/// preferred while at least 90 % of the branch's length remain.
/// \param tip node of the graph with one branch
/// \param distance from the tip along the centerline [mm]
/// \throw AlgorithmFailure if there is no closed section there, or the branch is too short; the
/// text names the tip
[[nodiscard]] OpeningPlace choose_opening_place(const Surface& surface,
                                                const CenterlineGraph& graph, std::size_t tip,
                                                std::optional<double> distance = std::nullopt);

/// True if an opening can be made there.
using PlaceTest = std::function<bool(const OpeningPlace&)>;

/// The place nearest to the tip that is accepted, anywhere on the branch; the section is closed and
/// has at least half of the vessel's area. Empty if there is none.
[[nodiscard]] std::optional<OpeningPlace> nearest_opening_place(const Surface& surface,
                                                                const CenterlineGraph& graph,
                                                                std::size_t tip,
                                                                const PlaceTest& accepts);

/// The same across the branch's furcation, on one of the other branches: where a vessel ends in a
/// furcation whose branches are too short to be cut. `distance` counts from the tip.
[[nodiscard]] std::optional<OpeningPlace> place_across_furcation(const Surface& surface,
                                                                 const CenterlineGraph& graph,
                                                                 std::size_t tip,
                                                                 const PlaceTest& accepts);

}  // namespace vesselbench
