#include "geometry/vessel/openings/place_warnings.h"

#include <cmath>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// If a larger fraction of a branch is given up, a warning says so.
constexpr double kNoticedShare = 0.1;
/// A larger tilt of an opening is mentioned [deg].
constexpr double kNoticedTiltDeg = 2.0;
/// So is a larger standard deviation of the direction that it was given [deg].
constexpr double kNoticedDoubtDeg = 2.0;

}  // namespace

std::string tilt_text(const OpeningPlace& place) {
    if (place.tilt_deg <= kNoticedTiltDeg) return "";
    return "tilted by " + formatted(place.tilt_deg, "%.0f degrees") + " against the vessel's axis";
}

std::vector<std::string> place_warnings(const OpeningPlace& place) {
    std::vector<std::string> warnings;
    const std::string at = place_text(place.plane.point);
    if (place.bend_deg > kBendDeg)
        warnings.push_back("the opening at " + at + " lies in a bend: the vessel turns by " +
                           formatted(place.bend_deg, "%.0f degrees") + " over one diameter");
    if (place.share > kNoticedShare)
        warnings.push_back("the opening at " + at + " gives up " +
                           std::to_string(std::lround(100.0 * place.share)) +
                           " % of its branch: the end is oblique or ragged");
    if (!place.measured)
        warnings.push_back("the vessel behind the opening at " + at +
                           " is too short to measure its axis: the opening follows the "
                           "centerline's direction");
    else if (place.doubt_deg > kNoticedDoubtDeg)
        warnings.push_back("the direction of the opening at " + at + " is known to " +
                           formatted(place.doubt_deg, "%.0f degrees") +
                           " only (one standard deviation): its vessel is short, uneven or few "
                           "voxels wide");
    if (const std::string tilt = tilt_text(place); !tilt.empty())
        warnings.push_back("the opening at " + at + " is " + tilt);
    return warnings;
}

}  // namespace vesselbench
