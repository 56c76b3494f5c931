#pragma once

#include "geometry/image/contrast_fit.h"
#include "geometry/image/image.h"
#include "geometry/image/vessel_body.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// What the levels at a vessel's wall are made of.
struct WallLevels {
    VesselContrast found;
    double lowest = 0.0, highest = 0.0;  ///< image values
    double core = 0.0;                   ///< [-] of the contrast: the most that the core reaches
    /// [-] of the vessel's volume, expected from the contrast's error: what the fit leaves, and
    /// what a core that does not reach the contrast leaves open
    double volume_error = 0.0;
    /// [-] of the wall, where the vessel is no wider than the blur: there is no radius to be found
    double undetermined = 0.0;
    double volume_at_threshold = 0.0;  ///< [-] of the volume that the levels enclose
};

/// The value that an image has at a vessel's wall, from place to place.
struct LevelField {
    Image levels;  ///< smooth along the wall; away from it, the threshold it started from
    WallLevels wall;
};

/// Finds the levels whose surface encloses what the vessel fills, however thin it is. A scanner's
/// blur leaves half the contrast at a flat wall only: at a thin vessel's less, at a neck's more.
/// The levels are found by synthesis: what they enclose is blurred, which says what an image has at
/// that wall; contrast and blur along each axis are those with which the blurred vessel is most
/// like the image (fit_contrast). So the volume is the integral of intensity over the contrast,
/// also where no core reaches that. The outline comes from the image: only the mean over a voxel or
/// two along the wall makes a level. Background and contrast are local as far as the image shows
/// them: a vessel as thin as the blur looks alike thin and bright or wide and dim, and has the
/// whole vessel's contrast. The error that is undone: Verbeek, van Vliet, "On the location error of
/// curved edges in low-pass filtered 2-D and 3-D images", IEEE PAMI 1994.
/// \param image the vessel is brighter than what is around it
/// \param threshold image value to start from, between background and vessel
/// \throw AlgorithmFailure if the image is not like a blurred vessel of one contrast; Cancelled
[[nodiscard]] LevelField find_levels(const Image& image, double threshold, const VesselBody& body,
                                     const Progress& progress = {});

}  // namespace vesselbench
