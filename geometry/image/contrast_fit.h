#pragma once

#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// How a scanner shows a vessel: how much brighter it is than what is around it, and how far it is
/// smeared.
struct VesselContrast {
    double contrast = 0.0;     ///< [-] image value that the vessel's inside adds
    Vec3 blur = Vec3::Zero();  ///< [mm] standard deviation of the point spread along i, j, k
    double residual = 0.0;     ///< [-] root mean square of what the fit leaves, over the contrast
    double error = 0.0;        ///< [-] standard error of the contrast, over the contrast
};

/// What a scanner with a certain blur makes of a vessel, by voxel.
struct ShownVessel {
    std::vector<float> share;       ///< [-] of the vessel in the voxel, blurred
    std::vector<float> wall;        ///< [1/mm] area of its wall per volume, blurred
    std::vector<float> background;  ///< [-] image value beside the vessel
    std::vector<float> near;        ///< not 0: a wall is near enough for the voxel to count
};

/// True where the image is bright though the vessel is not there: bone, or another vessel.
[[nodiscard]] bool is_other_structure(double brightness, float share);

/// The contrast and blur with which the shown vessel is most like the image: one step of Gauss and
/// Newton, least squares over the voxels that count. The wall's offset is one more unknown, so that
/// a vessel that is still too wide or too thin does not distort the others.
/// \param before its blur is that of `vessel`; a contrast of 0: of what is bright, nothing is left out
/// \throw AlgorithmFailure if the image does not decide
[[nodiscard]] VesselContrast fit_contrast(const Image& image, const ShownVessel& vessel,
                                          const VesselContrast& before);

}  // namespace vesselbench
