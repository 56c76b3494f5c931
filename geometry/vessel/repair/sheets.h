#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Splits the sheets that meet at non-manifold edges and vertices, and reverses triangles so that
/// neighbours agree. Vertices where only open rims meet are split only with `part_rims`: closing
/// the holes beside them is the better repair.
/// \throw AlgorithmFailure if the surface cannot be oriented (a Moebius strip)
void make_manifold(TriangleSoup& mesh, bool part_rims, RepairReport& report);

/// Reverses the surface if it faces inward (enclosed volume below 0, each component
/// separately).
void face_outward(TriangleSoup& mesh, RepairReport& report);

}  // namespace vesselbench
