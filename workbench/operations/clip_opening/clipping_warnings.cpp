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

/// "end 3", or "the open rim of end 3"; an end that belongs to another one has no number.
std::string name_of(const EndRecord& end) {
    const std::string number = end.number > 0 ? "end " + std::to_string(end.number) : "";
    if (end.rim) return "the open rim" + (number.empty() ? "" : " of " + number);
    return number.empty() ? "the end" : number;
}

Diagnostic decided(const EndRecord& end) {
    return {.code = "end-decided",
            .place = end.place,
            .figures = {{"diameter_mm", end.diameter}, {"number", end.number}},
            .words = {{"end", name_of(end)}, {"fate", to_string(end.fate)}, {"why", end.why}}};
}

/// How many small ends stayed closed, and how to open those that are no sacs, if they are few.
Diagnostic small_ends(const std::vector<EndRecord>& small) {
    constexpr std::size_t kMostNamed = 8;
    constexpr double kOffered = 0.2;  // less likely openings are not worth naming
    std::vector<std::string> places;
    for (const EndRecord& end : small)
        if (end.verdict && end.verdict->odds.opening > kOffered)
            places.push_back(coordinates_argument(end.place));
    Diagnostic warning{.code = "small-ends-closed",
                       .figures = {{"ends", static_cast<double>(small.size())}}};
    if (places.empty() || places.size() > kMostNamed) return warning;
    warning.figures["opened"] = static_cast<double>(places.size());
    warning.remedies = {{.arguments = {{"open", joined(places, ",")}}}};
    return warning;
}

}  // namespace

std::vector<Diagnostic> end_warnings(const OpeningPlan& plan) {
    std::vector<Diagnostic> warnings;
    std::vector<EndRecord> small;
    for (const EndRecord& end : plan.ends) {
        if (end.plain || end.why.empty() || end.asked) continue;
        if (end.fate == EndFate::Closed && !end.rim && end.share() <= kLeastShare)
            small.push_back(end);
        else
            warnings.push_back(decided(end));
    }
    if (!small.empty()) warnings.push_back(small_ends(small));
    return warnings;
}

std::optional<Diagnostic> tilt_warning(const ordered_json& openings) {
    constexpr double kNoticedTiltDeg = 10.0;
    std::vector<std::string> tilted;
    for (const ordered_json& opening : openings)
        if (opening["kept"] == true && opening["tilt_deg"].is_number() &&
            opening["tilt_deg"] > kNoticedTiltDeg)
            tilted.push_back(opening["name"].get<std::string>() + " by " +
                             formatted(opening["tilt_deg"], "%.0f degrees"));
    if (tilted.empty()) return std::nullopt;
    return Diagnostic{.code = tilted.size() == 1 ? "flat-end-tilted" : "flat-ends-tilted",
                      .words = {{"openings", joined(tilted)}},
                      .remedies = {{.arguments = {{"strict", "true"}}}}};
}

Diagnostic portal_inlet(const Surface& surface) {
    std::vector<std::string> inlets;
    for (const Patch& patch : surface.patches)
        if (patch.kind == PatchKind::Inlet) inlets.push_back(patch.name);
    return {.code = "portal-vein-inlet", .words = {{"inlets", enumerated(inlets)}}};
}

std::optional<Diagnostic> further_inlets(const Surface& surface) {
    const std::vector<std::size_t> likely = likely_inlets(surface);
    if (likely.empty()) return std::nullopt;
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
    return Diagnostic{.code = names.size() == 1 ? "further-inlet" : "further-inlets",
                      .words = {{"openings", enumerated(names)}},
                      .remedies = {{.arguments = {{"inlet", joined(places, ",")}}}}};
}

}  // namespace vesselbench
