#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/posing/pose.h"

namespace vesselbench {

/// How far a branch was moved.
struct BranchShift {
    Vec3 end = Vec3::Zero();    ///< of its line, away from the inlet, before [mm]
    double largest = 0.0;       ///< of a vertex of its wall or of what hangs on it [mm]
    Vec3 place = Vec3::Zero();  ///< of that vertex, before [mm]
};

/// A gap between two branches.
struct BranchGap {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< where it was smallest [mm]
    double before = 0.0;                          ///< [mm]
    double after = 0.0;  ///< [mm]; what is wider than twice the wanted gap counts as that
};

struct PartedBranches {
    Surface surface;
    std::vector<BranchGap> gaps;      ///< that were too small, the smallest first
    std::vector<BranchShift> shifts;  ///< the largest first
    double smallest_after = 0.0;  ///< of all gaps [mm]; twice the wanted one if there is none below
    int rounds = 0;               ///< of pushing
    std::vector<BentAxis> axes;
    double volume_before = 0.0, volume_after = 0.0;  ///< [mm^3]
};

/// Pushes branches apart until the walls of no two of them face each other with a gap (as
/// FacingWall; no folds) that is smaller. Branches are elastic rods (rod_energy.h), fixed at the
/// tree's root and carried by one another; the pose is the one of least energy in which all gaps
/// are open. Sections, lengths and caps stay as in deform_branch.
/// \param gap [mm]
/// \throw InvalidInput if the gap is not positive
/// \throw DiagnosedFailure "gap-not-reached" with the place of the smallest gap that is left,
/// "bend-too-strong", "posing-crosses-walls"; Cancelled
[[nodiscard]] PartedBranches part_branches(const Surface& surface, const CenterlineGraph& graph,
                                           double gap, const Progress& progress = {});

}  // namespace vesselbench
