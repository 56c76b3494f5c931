#pragma once

#include <array>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Gaussian smoothing of values on a grid, by kernels of exactly the variance asked for: narrow
/// ones are discrete Gaussians (Lindeberg, "Scale-space for discrete signals", IEEE PAMI 1990),
/// wide ones three boxes. The border value repeats outside. \param values i fastest, then j, then k
/// \param sigma standard deviations [voxels] along i, j, k, >= 0
void blur_grid(std::vector<float>& values, const std::array<int, 3>& size, const Vec3& sigma);

}  // namespace vesselbench
