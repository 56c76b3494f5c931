#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Parts the sheets that meet at non-manifold edges and vertices, and turns triangles so that
/// neighbours agree. Vertices where only open rims meet stay whole unless `part_rims`: closing the
/// holes beside them mends them better.
/// \throw AlgorithmFailure if the surface cannot be oriented (a Moebius strip)
void make_manifold(TriangleSoup& mesh, bool part_rims, RepairReport& report);

/// Turns the whole surface over if it faces inward (enclosed volume below 0, each component by
/// itself).
void face_outward(TriangleSoup& mesh, RepairReport& report);

}  // namespace vesselbench
