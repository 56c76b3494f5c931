#pragma once

#include <optional>

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Gaussian smoothing; near the border the kernel is truncated and normalised.
/// \param sigma standard deviation [mm], >= 0 (0: unchanged)
[[nodiscard]] Image gaussian(const Image& image, double sigma);

/// Parameters of edge-preserving diffusion.
struct DiffusionParameters {
    int iterations = 5;              ///< [-], >= 0
    std::optional<double> contrast;  ///< differences well above it stay; absent: edge_contrast()
};

/// Smooths noise and preserves edges: du/dt = div(g(|grad u|) grad u), g(d) = exp(-(d /
/// contrast)^2), explicit steps on the six neighbours, differences weighted by the voxel edges.
/// Source: Perona, Malik, "Scale-space and edge detection using anisotropic diffusion", PAMI 1990.
/// \throw Cancelled if the user cancels
[[nodiscard]] Image diffuse(const Image& image, const DiffusionParameters& parameters,
                            const Progress& progress = {});

/// A contrast that separates noise from edges: 1.4826 sqrt(5) times the median absolute difference
/// of neighbouring voxels that differ (robust statistics; flat background is ignored).
/// Source: Black, Sapiro, Marimont, Heeger, "Robust anisotropic diffusion", IEEE TIP 1998.
[[nodiscard]] double edge_contrast(const Image& image);

/// Grey dilation: the maximum over a box of (2 radius + 1)^3 voxels; of a mask, its dilation.
/// \param radius [voxels], >= 0
[[nodiscard]] Image dilated(const Image& image, int radius);

/// Grey erosion: the minimum over the same box. Voxels beyond the border are ignored.
[[nodiscard]] Image eroded(const Image& image, int radius);

/// Erosion, then dilation: removes structures thinner than 2 radius + 1 voxels.
[[nodiscard]] Image opened(const Image& image, int radius);

/// Dilation, then erosion: fills gaps narrower than 2 radius + 1 voxels.
[[nodiscard]] Image closed(const Image& image, int radius);

}  // namespace vesselbench
