#pragma once

#include <string>

#include "geometry/centerline_graph.h"

namespace vesselbench {

/// Writes centerlines as a .vtp file of polylines, one per branch from its start to its end node,
/// in mm, with the arrays VMTK's users expect: per point `MaximumInscribedSphereRadius` [mm] and
/// `Abscissas` [mm] from the branch's start; per line `GroupIds` and `CenterlineIds` (the branch's
/// number), `Blanking` (0), and `StartNodeIds`, `EndNodeIds` (nodes of the graph).
/// \throw UsageError for another suffix, IoError if the file cannot be written
void write_centerlines(const CenterlineGraph& graph, const std::string& path);

}  // namespace vesselbench
