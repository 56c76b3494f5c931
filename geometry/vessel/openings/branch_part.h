#pragma once

#include <cstddef>
#include <memory>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A branch that a point at its tip names.
struct NamedBranch {
    std::shared_ptr<const CenterlineGraph> graph;
    std::size_t tip = 0;  ///< node of the graph with one branch
};

/// The branch with its tip at a point. One that the automatic search leaves out, such as a sac,
/// gets a line of its own. The tip may be a little off, so that a branch keeps its name when an
/// edit before it moves the tip.
/// \param point on the wall or inside [mm]
/// \throw AlgorithmFailure if no tip is near the point, and what centerlines_of throws
[[nodiscard]] NamedBranch branch_at_tip(const Surface& surface, const Vec3& point,
                                        const Progress& progress = {});

/// What remove_branch cuts off at branch_at_tip, as a surface.
/// \param margin as for remove_branch [-]
/// \throw AlgorithmFailure as branch_at_tip and triangles_of_branch
[[nodiscard]] Surface branch_part(const Surface& surface, const Vec3& point, double margin,
                                  const Progress& progress = {});

}  // namespace vesselbench
