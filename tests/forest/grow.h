#pragma once

#include "tests/forest/plan.h"
#include "tests/forest/tree.h"

namespace vesselbench::forest {

/// Grows what a plan asks for, as far as there is room: no two vessels meet but at furcations.
/// The ends are not formed yet.
[[nodiscard]] Tree grow(const Plan& plan);

/// Gap [mm] between a point's vessel and another's line; negative if they overlap.
[[nodiscard]] double clearance(const LinePoint& point, const Line& line);

/// Whether `branch` begins or ends at `node`.
[[nodiscard]] bool meets(const Branch& branch, std::size_t node);

/// Area of the walls [mm^2], without overlaps taken into account.
[[nodiscard]] double wall_area(const Tree& tree);
[[nodiscard]] double thinnest_radius(const Tree& tree);

/// Edge of a surface's triangles [mm].
[[nodiscard]] double edge_for(const Plan& plan, const Tree& tree);

/// A straight line on from the end of `line`.
void extend(Line& line, double length);

/// A line whose direction wanders.
/// \param curl largest curvature times diameter [-]
[[nodiscard]] Line wandering(class Dice& dice, const LinePoint& start, const Vec3& direction,
                             double length, double curl);

/// Whether a new line keeps `gap` from all branches but those at `node`, from which it may start,
/// and does not come near itself.
[[nodiscard]] bool has_room(const Tree& tree, const Line& line, std::size_t node, double gap);

}  // namespace vesselbench::forest
