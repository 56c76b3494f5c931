#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/wall_section.h"

namespace vesselbench {

/// What a node of a rough graph is.
enum class NodeKind : std::uint8_t {
    Furcation,  ///< also the node of a ring
    Opening,    ///< a tip at a known place
    Blind       ///< a tip somewhere in a closed end
};

/// A centerline graph to voxel accuracy.
struct RoughGraph {
    std::vector<NodeKind> kinds;  ///< #nodes
    CenterlineGraph graph;        ///< openings stand at their centre; radii are depths
    double voxel = 0.0;           ///< [mm]
};

/// Moves the points of a rough graph to the middle of the vessel and smooths the lines; blind ends
/// are followed to where the vessel ends.
/// \param spacing of the points in local radii [-]
[[nodiscard]] CenterlineGraph refine(const RoughGraph& rough, const WallSections& wall,
                                     double spacing, const Progress& progress);

}  // namespace vesselbench
