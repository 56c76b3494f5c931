#pragma once

#include <vector>

#include "geometry/image/voxel_band.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// How far [mm] a function that separates a mask's voxels is from 0 at each of its band: a little
/// at the outline, the more the narrower the part; deeper voxels their distance from the outline.
/// \param spacing of the voxels along i, j, k [mm]
[[nodiscard]] std::vector<float> voxel_clearances(const VoxelBand& band, const Vec3& spacing);

/// Where the search for the function begins, and what bounds it, per voxel of a band.
struct BendingBounds {
    std::vector<float> start;  ///< [mm], positive inside
    /// [mm] the function is at least so far from 0 on the voxel's side; minus infinity: any value
    std::vector<float> least;
};

/// The function on a band of voxels with the least sum of squared second derivatives, mixed ones
/// included, within its bounds. Found by accelerated projected gradients, with the same bits on any
/// number of threads.
/// Source: Lempitsky, "Surface extraction from binary volumes with higher-order smoothness", CVPR
/// 2010; Nesterov 1983; restarts: O'Donoghue, Candes, "Adaptive restart for accelerated gradient
/// schemes", Found. Comput. Math. 2015.
/// \param spacing of the voxels along i, j, k [mm]
/// \throw Cancelled if the user cancels
[[nodiscard]] std::vector<float> least_bending(const VoxelBand& band, const Vec3& spacing,
                                               const BendingBounds& bounds, int steps,
                                               const Progress& progress = {});

}  // namespace vesselbench
