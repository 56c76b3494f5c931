#pragma once

#include <vector>

#include "smoothing/context/staircases.h"
#include "smoothing/context/voxel_grid.h"

namespace vesselbench {

/// Orientation change (Eq. 5.4) at a step of one slice over one voxel, the gentlest that marching
/// cubes can make of a mask: between the slice and the bevel beside it. 0.29 for cubic voxels, 0.55
/// for slices twice as thick as voxels, 0.72 at five times.
/// \param slice,voxel lengths of the edges, > 0
[[nodiscard]] double step_change(double slice, double voxel);

/// How a surface was extracted from its image.
enum class ImagedAs {
    Mask,         ///< steps are as sharp as the voxels allow
    Intensities,  ///< interpolated: the image's blur makes steps gentler
};

/// The axes and thresholds of staircase awareness (thesis 5.3.3) that suit an image's sampling.
struct StaircaseThresholds {
    StackAxes axes = Vec3::UnitZ();
    double tau_theta = 0.0;  ///< [-] below the orientation change of a step
    double tau_max = 0.0;    ///< [mm] slice distance (thesis 5.6)
    double step = 0.0;       ///< [-] the orientation change of a step between voxels
};

/// The orientation change above which a bend stands out of a surface's own: four times as far above
/// the middle of all changes as the 95th percentile is, but no less than 0.1. Above 1 on thin
/// vessels, which are round everywhere; on large round organs far below what blur leaves of a step.
/// \param change orientation change of every vertex, as from orientation_change; not empty
[[nodiscard]] double outstanding_change(std::vector<double> change);

/// For steps across one axis of the grid.
/// \param axis column of grid.axes
[[nodiscard]] StaircaseThresholds thresholds_across(const VoxelGrid& grid, int axis, ImagedAs as);

/// For steps across all axes of a grid of nearly cubic voxels.
[[nodiscard]] StaircaseThresholds thresholds_across_all(const VoxelGrid& grid, ImagedAs as);

/// The axis across which a mask has its steps, or all of cubic voxels, as the voxels' edges tell.
/// The images of intensities have steps across the slices only.
[[nodiscard]] bool steps_across_all(const VoxelGrid& grid, ImagedAs as);

}  // namespace vesselbench
