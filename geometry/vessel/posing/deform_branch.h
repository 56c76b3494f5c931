#pragma once

#include <cstddef>
#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/posing/pose.h"

namespace vesselbench {

/// How a branch is bent, as an elastic rod. Towards the inlet nothing moves beyond the reach. Away
/// from it the branch returns to its course within the reach, as far as its length permits; a free
/// end within half the reach keeps its direction and moves along.
struct BranchDeformation {
    Vec3 at = Vec3::Zero();  ///< place on the branch: the nearest one of the centerline [mm]
    /// By which the place is moved [mm], across the vessel; along it as far as its length permits.
    Vec3 move = Vec3::Zero();
    double straighten = 0.0;  ///< share of its bends that the vessel loses within reach [-], 0..1
    /// Length on each side of the place within which the branch bends [mm]; none: 8 radii of the
    /// vessel, or twice the move if that is more.
    std::optional<double> reach;

    bool operator==(const BranchDeformation&) const = default;
};

struct DeformedBranch {
    Surface surface;
    double reach = 0.0;          ///< [mm]
    Vec3 from = Vec3::Zero();    ///< the place on the centerline [mm]
    Vec3 to = Vec3::Zero();      ///< where it is afterwards [mm]
    double largest_shift = 0.0;  ///< of a vertex [mm]
    std::size_t moved_vertices = 0;
    double sharpest_radii = 0.0;  ///< of the strongest bend of the branch [radii of the vessel]
    double volume_before = 0.0, volume_after = 0.0;  ///< [mm^3]
    BentAxis axis;
};

/// Bends a branch of the vessel tree: its sections stay as they are, its length and volume too.
/// What hangs on its far end moves rigidly; caps stay flat; patches keep their triangles. Vertices
/// from the branch's root on and beyond the reach keep their bits.
/// Rods: rod_energy.h; binding of the wall: armature.h.
/// Without a move and a bend to straighten nothing moves: the result has the axis at rest.
/// \throw InvalidInput if a parameter is out of range
/// \throw DiagnosedFailure "no-branch-here", "place-is-rigid", "branch-too-short-to-bend",
/// "branch-in-loop", "move-not-reached", "bend-too-strong", "posing-crosses-walls", each with its
/// place; Cancelled
[[nodiscard]] DeformedBranch deform_branch(const Surface& surface, const CenterlineGraph& graph,
                                           const BranchDeformation& deformation,
                                           const Progress& progress = {});

}  // namespace vesselbench
