#include "geometry/vessel/openings/place_warnings.h"

#include <utility>

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

std::vector<Diagnostic> place_warnings(const OpeningPlace& place) {
    std::vector<Diagnostic> warnings;
    const auto add = [&](const char* code, std::map<std::string, double> figures) {
        warnings.push_back(
            {.code = code, .place = place.plane.point, .figures = std::move(figures)});
    };
    if (place.bend_deg > kBendDeg) add("opening-in-bend", {{"turn_deg", place.bend_deg}});
    if (place.share > kNoticedShare)
        add("opening-shortens-branch", {{"branch_percent", 100.0 * place.share}});
    if (!place.measured)
        add("opening-without-axis", {});
    else if (place.doubt_deg > kNoticedDoubtDeg)
        add("opening-direction-uncertain", {{"deviation_deg", place.doubt_deg}});
    if (place.tilt_deg > kNoticedTiltDeg) add("opening-tilted", {{"tilt_deg", place.tilt_deg}});
    return warnings;
}

}  // namespace vesselbench
