#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/vessel/repair/repair_parameters.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

// The soup's marks: 1 at rims cut by repair itself.

/// Mean edge length over all triangle sides [mm].
[[nodiscard]] double mean_side(const TriangleSoup& mesh);

[[nodiscard]] double area_of(const TriangleSoup& mesh);  ///< [mm^2]

[[nodiscard]] Vec3 centroid(const TriangleSoup& mesh, const Triangle& triangle);

/// Merges equal points, and rim points within `tolerance` [mm] of each other.
void weld(TriangleSoup& mesh, double tolerance, RepairReport& report);

/// Removes triangles that use a vertex twice, and all but the first of those with the same three
/// vertices.
void remove_degenerate_and_duplicate(TriangleSoup& mesh, RepairReport& report);

/// Keeps the `keep_components` components of largest area. Of a vessel's wall with an outer and an
/// inner side, unconnected, a count of 1 keeps the inner one, unless `outer_wall` is wanted.
/// \throw AlgorithmFailure if the largest one is only a small part of the surface: scattered
///        triangles are no surface
void keep_largest_components(TriangleSoup& mesh, const RepairParameters& parameters,
                             RepairReport& report);

}  // namespace vesselbench
