#pragma once

#include <vector>

#include "geometry/image/contrast_fit.h"

namespace vesselbench {

/// Means of the voxels beside the vessel, without those of other structures: where there are none
/// near, of those farther off. \return one image value for each voxel
[[nodiscard]] std::vector<float> local_background(const Image& image, const ShownVessel& vessel);

/// What the vessel adds to the background, by voxel.
struct LocalContrast {
    std::vector<float> contrast;  ///< [-] image value
    std::vector<float> offset;    ///< [-] image value, of the background
};

/// Regression of the image on the shown vessel and its wall in a window around each voxel. What it
/// cannot tell, it takes from the whole vessel: thin and bright looks like wide and dim where a
/// vessel is as thin as the blur.
/// \param contrast of the whole vessel [-]
[[nodiscard]] LocalContrast local_contrast(const Image& image, const ShownVessel& vessel,
                                           double contrast);

}  // namespace vesselbench
