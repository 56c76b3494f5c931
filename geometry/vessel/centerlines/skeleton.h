#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/vessel/centerlines/lumen_grid.h"

namespace vesselbench {

/// A stretch of a voxel curve between two nodes; the path starts and ends with the nodes' voxels.
struct SkeletonBranch {
    std::size_t from = 0;
    std::size_t to = 0;
    std::vector<VoxelId> path;
};

/// A voxel curve as a graph. Adjacent furcation voxels form one node, at the deepest of them.
struct Skeleton {
    std::vector<VoxelId> nodes;
    std::vector<SkeletonBranch> branches;

    /// Branch ends at every node (a loop counts twice), #nodes.
    [[nodiscard]] std::vector<int> degrees() const;
};

/// \param curve voxels of a thinned lumen, ascending
[[nodiscard]] Skeleton skeleton_of(const LumenGrid& grid, std::span<const VoxelId> curve);

/// Minimum length of a blind branch [-]: its length outside the parent's inscribed spheres must
/// exceed the larger of two sizes.
struct BlindBranchRule {
    double beyond_parent = 1.0;  ///< times the parent's radius [-]
    double slenderness = 2.5;    ///< times the branch's own largest radius out there [-]
    double widest = std::numeric_limits<double>::infinity();  ///< wider ones are none [mm]
};

/// A blind branch beyond its parent's inscribed spheres.
struct BlindReach {
    VoxelId root = 0;     ///< of the furcation
    VoxelId exit = 0;     ///< the last voxel within the parent
    VoxelId tip = 0;      ///< its end
    double length = 0.0;  ///< from the parent's spheres to the wall at the tip [mm]
    double widest = 0.0;  ///< largest depth out there [mm]
};

/// \param tip index of the branch's end node; the other end is a furcation
[[nodiscard]] BlindReach blind_reach(const LumenGrid& grid, const Skeleton& skeleton,
                                     std::size_t branch, std::size_t tip);

/// Ratio of the length beyond the parent to that minimum; below 1 the branch is a bump or a sac; 0
/// if it is too wide.
[[nodiscard]] double significance(const LumenGrid& grid, const BlindReach& reach,
                                  const BlindBranchRule& rule);

/// Anchors of a curve's ends.
struct CurveAnchors {
    std::span<const VoxelId> fixed;  ///< kept whatever their branch
    std::vector<VoxelId>& blind;     ///< kept if their branch is significant
    /// Of these, the ones that hardly rise (summits): their branch has to be thin, too.
    std::span<const VoxelId> low = {};
};

/// A curve without its insignificant blind branches.
struct PrunedCurve {
    std::vector<VoxelId> voxels;
    std::vector<BlindReach> dropped;  ///< the branches that went
};

/// Removes them in ascending order of significance.
/// \param anchors on return the remaining ones
/// \throw Cancelled if the user cancels
[[nodiscard]] PrunedCurve prune(const LumenGrid& grid, std::vector<VoxelId> curve,
                                const CurveAnchors& anchors, const BlindBranchRule& rule,
                                const Progress& cancel);

/// A maximum of the geodesic distance.
struct Summit {
    VoxelId voxel = 0;
    double rise = 0.0;  ///< above the highest pass to a higher one [mm]; infinite: there is none
};

/// The maxima that rise at least `height` [mm]: candidates for the ends of blind branches, by voxel
/// index. \throw Cancelled if the user cancels
[[nodiscard]] std::vector<Summit> summits(const LumenGrid& grid, std::span<const float> geodesic,
                                          double height, const Progress& cancel);

}  // namespace vesselbench
