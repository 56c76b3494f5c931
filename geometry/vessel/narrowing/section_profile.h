#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/vessel/tree/wall_rings.h"

namespace vesselbench {

/// The mean radial profile of a vessel's image.
struct SectionProfile {
    std::vector<double> radii;   ///< from the axis, ascending, evenly [mm]
    std::vector<double> values;  ///< image values
    double wall = 0.0;           ///< mean radius of the found wall [mm]
};

/// Medians over the rings' directions. Within the wall, a direction's distances are scaled to the
/// mean radius; outside, they are moved to it: sections of any shape become round.
/// \param chosen the rings to take \param reach beyond the wall [mm]
/// \return empty if the image shows less than half of it
[[nodiscard]] std::optional<SectionProfile> section_profile(
    const Image& image, const std::vector<WallRing>& rings,
    const std::function<bool(const WallRing&)>& chosen, double reach);

/// A disc of value 1 blurred by a Gaussian, at a distance from its centre.
/// \param blur standard deviation, > 0; all in [mm]
[[nodiscard]] double blurred_disc(double distance, double radius, double blur);

/// A disc, or a lumen whose contrast changes with the square of the distance from its axis, as the
/// image would show it.
struct DiscFit {
    double radius = 0.0;    ///< [mm]
    double blur = 0.0;      ///< [mm]
    double contrast = 0.0;  ///< on the axis, image value above the background
    double at_wall = 0.0;   ///< contrast at the wall
    double background = 0.0;
    double misfit = 0.0;  ///< root mean square of what is left, image value
};

/// Which values of a disc are given.
struct DiscQuestion {
    std::vector<double> radii;       ///< tried [mm]
    std::vector<double> blurs;       ///< tried [mm]
    std::optional<double> contrast;  ///< none: any
    bool may_fall = false;           ///< the contrast at the wall may differ from that on the axis
};

/// Least squares; every point counts alike.
[[nodiscard]] DiscFit fitted_disc(const SectionProfile& profile, const DiscQuestion& question);

}  // namespace vesselbench
