#pragma once

#include <optional>

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/phantoms/description.h"

namespace vesselbench {

/// A phantom's image, its segmentation and its true surface.
struct Phantom {
    Image image;                   ///< blurred, noisy intensities
    Image mask;                    ///< labels 0 and 1 on the image's grid, as if segmented by hand
    Surface exact;                 ///< the true surface
    std::optional<Surface> noisy;  ///< the true surface with noise along its normals, if described
    std::optional<Surface> neighbour;  ///< another structure beside it, if described
};

/// Makes everything in a description; the same description gives the same bits.
/// \throw InvalidInput if the description is not usable (no part, sizes not positive, an image
/// above 256 Mi voxels, a surface sampled at more points); Cancelled if the user cancels
[[nodiscard]] Phantom make_phantom(const PhantomDescription& description,
                                   const Progress& progress = {});

}  // namespace vesselbench
