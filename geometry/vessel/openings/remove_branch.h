#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

struct BranchRemoval {
    Surface surface;
    Vec3 mouth = Vec3::Zero();  ///< where the branch left its parent [mm]
    double removed_area = 0.0;  ///< of the removed wall [mm^2]
    std::size_t new_triangles = 0;
    bool follows_parent = false;  ///< the new wall continues the parent's tube; false: it only
                                  ///< continues the wall around the hole
};

struct BranchRemovalParameters {
    /// Width of the parent's wall to rebuild beyond the branch's foot, in radii of the branch [-].
    double margin = 0.4;
    int continuity = 1;  ///< at the new wall's rim: 1 tangent, 2 curvature
};

/// Removes a branch (or an aneurysm's sac) with everything at its end and rebuilds the parent's
/// wall. The cut follows the parent's wall: what is closer to the branch's tube than to those of
/// the other vessels is removed. On a single parent the hole is filled in the coordinates of the
/// parent's tube (out, around, along), in which a tube is flat: neither a bump nor a flat disc
/// remains.
/// \param tip node of the graph with one branch, on the centerline of `surface`
/// \throw AlgorithmFailure if the branch has no parent vessel, is as wide as its parent, is the
/// trunk (is_trunk), or takes nearly all of the wall along; the text names the tip
[[nodiscard]] BranchRemoval remove_branch(const Surface& surface, const CenterlineGraph& graph,
                                          std::size_t tip,
                                          const BranchRemovalParameters& parameters = {});

/// What remove_branch cuts off: 1 for each triangle that goes, else 0; #T.
/// \throw AlgorithmFailure if the branch has no parent vessel
[[nodiscard]] std::vector<std::uint8_t> triangles_of_branch(
    const Surface& surface, const CenterlineGraph& graph, std::size_t tip,
    const BranchRemovalParameters& parameters = {});

}  // namespace vesselbench
