#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// Boxes around the changes: only there can new self-intersections arise.
using Regions = std::vector<BoxTree::Box>;

/// Self-intersecting pairs among the triangles that touch one of the regions.
[[nodiscard]] std::vector<TrianglePair> self_intersections_in(const TriangleSoup& mesh,
                                                              const Regions& regions,
                                                              const Progress& progress);

/// One attempt at removing self-intersections; `attempt` counts from 0. The first attempts smooth
/// the vertices around, later ones cut the triangles out, each time one ring more; the rims are
/// marked as cut, to be closed again.
/// \return the regions changed
[[nodiscard]] Regions untangle(TriangleSoup& mesh, const std::vector<TrianglePair>& pairs,
                               int attempt, RepairReport& report);

/// The number of useful attempts.
inline constexpr int kUntangleAttempts = 9;

}  // namespace vesselbench
