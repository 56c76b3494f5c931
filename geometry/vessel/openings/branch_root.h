#pragma once

#include <vector>

#include "geometry/kernel/vec3.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/tree/tube.h"

namespace vesselbench {

/// A branch to be removed and its parent vessels.
struct BranchRoot {
    std::size_t branch = 0;
    std::size_t node = 0;        ///< the furcation
    Vec3 mouth = Vec3::Zero();   ///< where the branch's line leaves the parent [mm]
    double branch_radius = 0.0;  ///< of the branch just behind its mouth [mm]
    double parent_radius = 0.0;  ///< of the parent at the mouth [mm]
    std::vector<Tube> parents;   ///< one for each pair of the other vessels at the furcation:
                                 ///< line and radius continue smoothly, as if the branch had
                                 ///< never existed
    std::vector<Tube> others;    ///< the vessels elsewhere
    Tube own;                    ///< the branch from its mouth on
};

/// \param tip node of the graph with one branch
/// \throw AlgorithmFailure if the branch has no furcation, or fewer than two others meet there
[[nodiscard]] BranchRoot branch_root(const CenterlineGraph& graph, std::size_t tip);

}  // namespace vesselbench
