#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/stubs.h"

namespace vesselbench {

/// A blind branch, or what would be one if it were longer.
struct ShortBranch {
    Vec3 tip = Vec3::Zero();  ///< [mm]
    double length = 0.0;      ///< beyond the vessel it leaves [mm]
    double diameter = 0.0;    ///< of the branch [mm]
    double parent = 0.0;      ///< diameter of the vessel that it leaves [mm]
    bool has_line = false;    ///< it is a branch of the centerlines
};

/// Blind branches shorter than 2.5 of their diameters, the shortest beside its diameter first. An
/// end that is open or flat was cut, and is no blind one; nor is a branch that continues a vessel
/// straight through its furcation. A branch without a line counts if it rises from its parent by a
/// quarter of the parent's radius at least: what is flatter, noise is too.
/// \param graph, stubs of the surface
/// \throw Cancelled
[[nodiscard]] std::vector<ShortBranch> short_branches(const Surface& surface,
                                                      const CenterlineGraph& graph,
                                                      std::span<const Stub> stubs,
                                                      const Progress& progress = {});

}  // namespace vesselbench
