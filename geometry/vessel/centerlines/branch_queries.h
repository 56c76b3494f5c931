#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A place on a branch: arc length [mm] from the branch's start node, in [0, length].
struct BranchPlace {
    std::size_t branch = 0;
    double abscissa = 0.0;  ///< [mm]
};

/// The place of the graph that is closest to a position, and its distance.
struct NearestPlace {
    BranchPlace place;
    double distance = 0.0;  ///< [mm] from the position to the line
};

/// Arc length [mm] from the first point to every point of the branch, #points.
[[nodiscard]] std::vector<double> abscissas(const CenterlineBranch& branch);

/// Arc length [mm] of the branch.
[[nodiscard]] double branch_length(const CenterlineBranch& branch);

/// Point on the branch [mm]; an abscissa outside [0, length] is clamped to it.
[[nodiscard]] Vec3 point_at(const CenterlineBranch& branch, double abscissa);

/// Radius of the maximal inscribed sphere [mm], linear between the branch's points; clamped.
[[nodiscard]] double radius_at(const CenterlineBranch& branch, double abscissa);

/// Unit direction of the branch from its start towards its end: the slope of a quadratic fitted to
/// the points within `window` [mm] of arc length on each side. One-sided at the ends.
/// \param window 0 uses one local radius
[[nodiscard]] Vec3 tangent_at(const CenterlineBranch& branch, double abscissa, double window = 0.0);

/// The closest place on all branches, exact on the polyline's segments; empty for a graph without
/// branches. Of equal distances the lowest branch, then the lowest abscissa wins.
[[nodiscard]] std::optional<NearestPlace> nearest_place(const CenterlineGraph& graph,
                                                        const Vec3& position);

/// The same on one branch.
[[nodiscard]] std::optional<NearestPlace> nearest_place(const CenterlineGraph& graph,
                                                        std::size_t branch, const Vec3& position);

/// Indices of the tip nodes, the widest vessel first (tip_radius; ties by node index).
[[nodiscard]] std::vector<std::size_t> tips_by_radius(const CenterlineGraph& graph);

/// The tip node closest to a position; empty if the graph has no tips.
[[nodiscard]] std::optional<std::size_t> nearest_tip(const CenterlineGraph& graph,
                                                     const Vec3& position);

/// Size of the vessel at a tip [mm]: median radius over its last stretch, from half a radius to
/// two radii inward. The tip's own sphere may be small in a rounded end.
/// \throw InvalidInput if the node is not a tip
[[nodiscard]] double tip_radius(const CenterlineGraph& graph, std::size_t tip);

/// The tip that a point means: the nearest one, if it is near; else none.
/// \param reach largest distance from the point [radii of the tip, tip_radius]; by default far enough
///        for a tip that another edit has moved a little
[[nodiscard]] std::optional<std::size_t> tip_near(const CenterlineGraph& graph,
                                                  const Vec3& position, double reach = 3.0);

/// The branch that ends at a tip. \throw InvalidInput if the node is not a tip
[[nodiscard]] std::size_t branch_of_tip(const CenterlineGraph& graph, std::size_t tip);

/// The branch's other end node.
/// \throw InvalidInput if the branch does not end at the node
[[nodiscard]] std::size_t other_node(const CenterlineGraph& graph, std::size_t branch,
                                     std::size_t node);

/// The place `distance` [mm] of arc length inward from the tip, on the tip's own branch; empty if
/// the branch is shorter.
[[nodiscard]] std::optional<BranchPlace> inward_from_tip(const CenterlineGraph& graph,
                                                         std::size_t tip, double distance);

/// Unit direction out of the vessel, along the tip's branch, `distance` [mm] inward from the tip.
/// \param window as for tangent_at
[[nodiscard]] Vec3 outward_direction(const CenterlineGraph& graph, std::size_t tip, double distance,
                                     double window = 0.0);

/// Position [mm] on the straight continuation of the line, `distance` [mm] beyond the tip. The
/// direction is that of the last two radii.
[[nodiscard]] Vec3 beyond_tip(const CenterlineGraph& graph, std::size_t tip, double distance);

/// Arc length [mm] from one of the branch's end nodes.
/// \param node start_node or end_node of the branch
/// \throw InvalidInput if it is neither
[[nodiscard]] double distance_from_node(const CenterlineGraph& graph, const BranchPlace& place,
                                        std::size_t node);

/// The branch's place at an arc length [mm] from one of its end nodes, clamped to the branch.
[[nodiscard]] BranchPlace place_from_node(const CenterlineGraph& graph, std::size_t branch,
                                          std::size_t node, double distance);

/// Arc length [mm] from the furcation at which the branch becomes a separate vessel: beyond it, its
/// inscribed spheres overlap none of the other branches at this node. The whole length if it never
/// does; 0 at a tip.
[[nodiscard]] double furcation_zone_end(const CenterlineGraph& graph, std::size_t branch,
                                        std::size_t node);

/// Arc length [mm] from the furcation at which the branch's line leaves the inscribed spheres of
/// the other branches at this node, before its own spheres do. The whole length if it never does; 0
/// at a tip.
[[nodiscard]] double parents_exit(const CenterlineGraph& graph, std::size_t branch,
                                  std::size_t node);

}  // namespace vesselbench
