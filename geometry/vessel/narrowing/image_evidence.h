#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/vessel/narrowing/narrowing.h"
#include "geometry/vessel/tree/wall_rings.h"

namespace vesselbench {

/// What the image says about a narrowing of the surface.
enum class ImageVerdict {
    ContrastFalls,  ///< the lumen is as wide as beside it, but darker: an artefact of the surface
    ImageAgrees,    ///< the lumen is as bright as beside it, but narrow
    CannotTell
};

[[nodiscard]] std::string to_string(ImageVerdict verdict);  ///< "contrast-falls" ...

/// The image's section at a narrowing, compared with those of the same vessel beside it.
struct ImageEvidence {
    ImageVerdict verdict = ImageVerdict::CannotTell;
    double core_contrast = 0.0;  ///< mean along the axis, over that beside the narrowing [-]
    double integral = 0.0;  ///< of the section's contrast, over that beside the narrowing [-]: the
                            ///< share of the contrast if it falls, of the area if the lumen is
                            ///< narrow
    double edge_radius = 0.0;     ///< where the mean profile falls steepest [mm]
    double lumen_radius = 0.0;    ///< of the blurred disc that is most like the profile [mm]
    double lumen_contrast = 0.0;  ///< of that disc, over that beside the narrowing [-]
    double misfit_falls = 0.0;    ///< root mean square that is left by a lumen of the expected
                                  ///< radius whose contrast falls, over the contrast [-]
    double misfit_agrees = 0.0;   ///< the same of a narrow lumen of the contrast beside it [-]
};

/// Profiles are medians around the axis by the distance from the found wall, so that the section's
/// shape and a neighbour on one side do not count; beside the narrowing, they give contrast and
/// blur. The narrowing's is then fitted with a blurred disc twice: of the expected radius with a
/// contrast that may fall towards the wall, and of the contrast beside it with any radius.
/// \param image intensities, in which the vessel may also be the darker part
/// \param rings of the narrowing's branch (wall_rings)
/// \return empty if the image does not show the place, or nothing is beside it
[[nodiscard]] std::optional<ImageEvidence> image_evidence(const Image& image,
                                                          const std::vector<WallRing>& rings,
                                                          const Narrowing& narrowing);

}  // namespace vesselbench
