#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/wall_section.h"

namespace vesselbench {

/// The kind of a node in a rough graph.
enum class NodeKind : std::uint8_t {
    Furcation,  ///< also the node of a ring
    Opening,    ///< a tip at a known position
    Blind       ///< a tip somewhere in a closed end
};

/// A centerline graph to voxel accuracy.
struct RoughGraph {
    std::vector<NodeKind> kinds;  ///< #nodes
    CenterlineGraph graph;        ///< openings are at their centre; radii are depths
    double voxel = 0.0;           ///< [mm]
};

/// Moves the points of a rough graph to the middle of the vessel and smooths the lines; blind ends
/// are extended to the end of the vessel.
/// \param spacing of the points in local radii [-]
[[nodiscard]] CenterlineGraph refine(const RoughGraph& rough, const WallSections& wall,
                                     double spacing, const Progress& progress);

}  // namespace vesselbench
