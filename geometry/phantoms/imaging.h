#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"
#include "geometry/phantoms/description.h"
#include "geometry/phantoms/field.h"

namespace vesselbench {

/// The phantom as a scanner sees it: blurred, noisy intensities.
/// \throw InvalidInput if a spacing is not positive, the image would have over 256 Mi voxels, or a
/// contrast dip has no reach or its centre is outside its vessel
[[nodiscard]] Image phantom_image(const PhantomDescription& description, const PhantomField& field,
                                  const Progress& progress = {});

/// The phantom as an expert segments it: labels 0 and 1 on the image's grid.
/// \throw InvalidInput as phantom_image
[[nodiscard]] Image phantom_mask(const PhantomDescription& description, const PhantomField& field,
                                 const Progress& progress = {});

}  // namespace vesselbench
