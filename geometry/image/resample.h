#pragma once

#include "geometry/image/image.h"

namespace vesselbench {

/// Resamples intensities to cubic voxels with an interpolating cubic B-spline (mirrored at the
/// border). The grid keeps its axes and its first voxel.
/// Source: Unser, Aldroubi, Eden, "B-spline signal processing: part II", IEEE Trans. Signal
/// Processing 1993; thesis 3.2.3.
/// \param edge length of the new voxels [mm], > 0
/// \throw InvalidInput if edge is not above 0, or the result would have more than 2^30 voxels or a
/// single one
[[nodiscard]] Image resample_intensities(const Image& image, double edge);

/// Resamples a mask (inside where >= 0.5) to cubic voxels by shape: the signed distances to the
/// outline within each slice are interpolated linearly between slices; the result is 0 or 1.
/// Slices are those across the axis with the largest voxel edge.
/// Source: Raya, Udupa, "Shape-based interpolation of multidimensional objects", IEEE Trans.
/// Medical Imaging 1990; distances: Felzenszwalb, Huttenlocher, "Distance transforms of sampled
/// functions", Theory of Computing 2012; thesis 3.2.3.
/// \throw as resample_intensities
[[nodiscard]] Image resample_mask(const Image& mask, double edge);

}  // namespace vesselbench
