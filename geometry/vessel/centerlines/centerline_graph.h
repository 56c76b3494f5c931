#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A furcation or a tip of the vessel tree.
struct CenterlineNode {
    Vec3 position = Vec3::Zero();       ///< [mm]
    double radius = 0.0;                ///< maximal inscribed sphere [mm]
    std::vector<std::size_t> branches;  ///< indices of the branches that end here; one entry: a tip

    [[nodiscard]] bool is_tip() const { return branches.size() == 1; }
};

/// A stretch of vessel between two nodes, sampled densely from start_node to end_node (both
/// included).
struct CenterlineBranch {
    std::size_t start_node = 0;
    std::size_t end_node = 0;
    Positions points;           ///< [mm], centres of maximal inscribed spheres
    std::vector<double> radii;  ///< [mm], radius of the maximal inscribed sphere at each point
};

/// The vessel tree's centerlines as a graph; loops occur (circle of Willis).
struct CenterlineGraph {
    std::vector<CenterlineNode> nodes;
    std::vector<CenterlineBranch> branches;
};

}  // namespace vesselbench
