#include "workbench/operations/clip_opening/clipping_warnings.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

std::string end_text(const EndRecord& end) {
    return (end.rim ? "the open rim at " : "the end at ") + place_text(end.place) + ", diameter " +
           formatted(end.diameter) + " mm";
}

/// How many small ends stayed closed, and how to open those that are no sacs, if they are few.
std::string small_ends_text(const std::vector<EndRecord>& small) {
    constexpr std::size_t kMostNamed = 8;
    constexpr double kOffered = 0.2;  // less likely openings are not worth naming
    std::vector<std::string> places;
    for (const EndRecord& end : small)
        if (end.verdict && end.verdict->odds.opening > kOffered)
            places.push_back(coordinates_argument(end.place));
    const std::string text =
        counted(small.size(), "smaller end") + " stayed closed: see the report";
    if (places.empty() || places.size() > kMostNamed) return text;
    return text + "; open=" + joined(places, ",") + " opens " +
           (places.size() == 1 ? "one" : std::to_string(places.size())) + " of them";
}

}  // namespace

std::vector<std::string> end_warnings(const OpeningPlan& plan) {
    std::vector<std::string> warnings;
    std::vector<EndRecord> small;
    for (const EndRecord& end : plan.ends) {
        if (end.plain || end.why.empty() || end.asked) continue;
        if (end.fate == EndFate::Closed && !end.rim && end.share() <= kLeastShare)
            small.push_back(end);
        else
            warnings.push_back(end_text(end) + ", was " + to_string(end.fate) + ": " + end.why);
    }
    if (!small.empty()) warnings.push_back(small_ends_text(small));
    return warnings;
}

std::string tilt_warning(const ordered_json& openings) {
    constexpr double kNoticedTiltDeg = 10.0;
    std::vector<std::string> tilted;
    for (const ordered_json& opening : openings)
        if (opening["kept"] == true && opening["tilt_deg"].is_number() &&
            opening["tilt_deg"] > kNoticedTiltDeg)
            tilted.push_back(opening["name"].get<std::string>() + " by " +
                             formatted(opening["tilt_deg"], "%.0f degrees"));
    if (tilted.empty()) return "";
    const bool one = tilted.size() == 1;
    return std::string(one ? "a flat end was" : "flat ends were") +
           " kept although tilted against the vessel's axis: " + joined(tilted) +
           "; strict=true cuts " + (one ? "it" : "them") + " across";
}

std::string further_inlets(const Surface& surface) {
    const std::vector<std::size_t> likely = likely_inlets(surface);
    if (likely.empty()) return "";
    std::vector<std::string> names, places;
    const auto add = [&](std::size_t patch) {
        places.push_back(to_text(Value(rounded_place(patch_shape(surface, patch).plane.point))));
    };
    for (std::size_t p = 0; p < surface.patches.size(); ++p)
        if (surface.patches[p].kind == PatchKind::Inlet) add(p);
    for (const std::size_t p : likely) {
        names.push_back(surface.patches[p].name);
        add(p);
    }
    return enumerated(names) + (names.size() == 1 ? " faces" : " face") +
           " the same way as the inlet: if blood flows in there as well, give inlet=" +
           joined(places, ",");
}

}  // namespace vesselbench
