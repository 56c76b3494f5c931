#include "smoothing/context/staircase_thresholds.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

// Thresholds lie this far below the change of a step [-]: little below the sharp ones of masks,
// more below those that the image's blur has made gentler.
constexpr double kBelowSharp = 0.9, kBelowBlurred = 0.75;

/// The thesis's value, for slices much thicker than voxels: no threshold is higher.
constexpr double kHighest = 0.7;

/// The roundness of a thin vessel alone changes the orientation by up to this: interpolated steps
/// are not looked for below it.
constexpr double kRoundness = 0.5;

/// Bends below this stand out of nothing [-]: a facet tilted by 26 degrees beside one in a slice.
constexpr double kGentlest = 0.1;

/// What stands out lies this many times as far from the middle as the 95th percentile does.
constexpr double kOutlying = 4.0;

double threshold(double step, ImagedAs as) {
    if (as == ImagedAs::Mask) return std::min(kHighest, kBelowSharp * step);
    return std::clamp(kBelowBlurred * step, kRoundness, kHighest);
}

StaircaseThresholds thresholds(const StackAxes& axes, double slice, double voxel, ImagedAs as) {
    const double step = step_change(std::max(slice, voxel), voxel);
    // Three digits, as a user would type them, keep their bits wherever they are read back.
    return {axes, three_digits(threshold(step, as)), three_digits(slice), step};
}

}  // namespace

double outstanding_change(std::vector<double> change) {
    const double middle = percentile(change, 0.5), most = percentile(change, 0.95);
    return std::max(kGentlest, middle + kOutlying * (most - middle));
}

double step_change(double slice, double voxel) {
    return 1.0 - voxel / std::hypot(slice, voxel);
}

StaircaseThresholds thresholds_across(const VoxelGrid& grid, int axis, ImagedAs as) {
    const double voxel = std::max(grid.spacing[(axis + 1) % 3], grid.spacing[(axis + 2) % 3]);
    return thresholds(Vec3(grid.axes.col(axis)), grid.spacing[axis], voxel, as);
}

StaircaseThresholds thresholds_across_all(const VoxelGrid& grid, ImagedAs as) {
    return thresholds(grid.axes, grid.spacing.maxCoeff(), grid.spacing.maxCoeff(), as);
}

bool steps_across_all(const VoxelGrid& grid, ImagedAs as) {
    return as == ImagedAs::Mask && grid.is_cubic();
}

}  // namespace vesselbench
