#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/extrude.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

[[noreturn]] void refuse_without_openings() {
    throw DiagnosedFailure({.code = "no-openings",
                            .operation = "extrude-opening",
                            .remedies = {{.operation = "clip-opening"}}});
}

std::size_t patch_named(const Surface& surface, const std::string& name) {
    std::string known;
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        const Patch& patch = surface.patches[p];
        if (patch.kind == PatchKind::Wall) continue;
        if (patch.name == name) return p;
        known += (known.empty() ? "" : ", ") + patch.name;
    }
    if (known.empty()) refuse_without_openings();
    throw DiagnosedFailure({.code = "no-such-opening",
                            .operation = "extrude-opening",
                            .words = {{"opening", name}, {"known", known}},
                            .remedies = {{.arguments = {{"opening", ""}}}}});
}

std::vector<std::string> chosen_openings(const Surface& surface, const Arguments& arguments) {
    std::vector<std::string> names;
    if (const auto given = arguments.optional_text("opening")) {
        std::istringstream list(*given);
        for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    } else {
        for (const Patch& patch : surface.patches)
            if (patch.kind == PatchKind::Inlet || patch.kind == PatchKind::Outlet)
                names.push_back(patch.name);
    }
    if (names.empty()) refuse_without_openings();
    return names;
}

/// The usual length in diameters would make the tubes of a wide vessel the larger part of a model.
double usual_length(const Arguments& arguments, double diameter, double extent) {
    return std::min(arguments.real("diameters") * diameter, arguments.real("share") * extent);
}

/// A stored length below this fraction of the usual one is worth a word: the usual one itself
/// changes a little with the surface [-].
constexpr double kNoticedShort = 0.95;

/// The vessel's own direction at a cap; none, with a warning, if it cannot be used.
std::optional<Vec3> vessel_direction(const Surface& surface, std::size_t patch,
                                     std::vector<Diagnostic>& warnings) {
    constexpr double kMostTilt = 60.0;
    const auto axis = axis_at_patch(surface, patch);
    if (axis && axis->tilt_deg <= kMostTilt) return axis->direction;
    Diagnostic warning{.code = axis ? "cap-tilted" : "cap-without-axis",
                       .place = patch_shape(surface, patch).plane.point,
                       .words = {{"opening", surface.patches[patch].name}}};
    if (axis) warning.figures["tilt_deg"] = axis->tilt_deg;
    warnings.push_back(std::move(warning));
    return std::nullopt;
}

/// \param wanted length that the arguments ask for [mm]
Diagnostic short_extrusion(const std::string& name, const Extrusion& made, double wanted) {
    return {.code = made.shortened ? "extrusion-shortened" : "extrusion-as-before",
            .figures = {{"length_mm", made.length}, {"wanted_mm", wanted}},
            .words = {{"opening", name}}};
}

/// Of an opening with something right in front of it: nothing can be put there.
/// \param code "opening-blocked", or of one that is left out "opening-not-extruded"
Diagnostic blocked_opening(const char* code, const Surface& surface, const std::string& name) {
    return {.code = code,
            .operation = "extrude-opening",
            .place = patch_shape(surface, patch_named(surface, name)).plane.point,
            .words = {{"opening", name}}};
}

/// Of all openings, most can do without a few; one that was asked for cannot be left out.
/// \throw AlgorithmFailure if it was, or none is left
void tell_blocked(const Surface& surface, const std::vector<std::string>& blocked, bool required,
                  std::vector<Diagnostic>& warnings) {
    if (!blocked.empty() && required)
        throw DiagnosedFailure(blocked_opening("opening-blocked", surface, blocked.front()));
    for (const std::string& name : blocked)
        warnings.push_back(blocked_opening("opening-not-extruded", surface, name));
}

Outcome extrude(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Surface surface = surface_of(scene);
    const auto names = chosen_openings(surface, arguments);
    const auto stored =
        arguments.has("lengths") ? arguments.list("lengths") : std::vector<double>{};
    if (!stored.empty() && stored.size() != names.size())
        throw UsageError("extrude-opening: lengths needs one number for each opening");
    Outcome outcome;
    outcome.resolved = arguments;
    const double extent = bounds(surface).diagonal();
    std::vector<double> lengths;
    std::string list;
    std::vector<std::string> limited, blocked;
    ordered_json report = ordered_json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(names.size()), names[i]);
        const std::size_t patch = patch_named(surface, names[i]);
        const double diameter = patch_shape(surface, patch).diameter();
        ExtrusionParameters parameters{
            .length = arguments.has("length") ? arguments.real("length")
                                              : usual_length(arguments, diameter, extent),
            .direction = arguments.text("direction") == "centerline"
                             ? vessel_direction(surface, patch, outcome.warnings)
                             : std::nullopt,
            .profile = arguments.text("profile") == "keep" ? ExtrusionProfile::Keep
                                                           : ExtrusionProfile::Circle,
            .blend = arguments.real("blend")};
        if (!arguments.has("length") && parameters.length < arguments.real("diameters") * diameter)
            limited.push_back(names[i]);
        const double wanted = parameters.length;
        if (!stored.empty()) parameters.length = stored[i];
        parameters.may_shorten = stored.empty();
        const Extrusion made = extrude_opening(surface, patch, parameters);
        if (!(made.length > 0.0)) {
            blocked.push_back(names[i]);
            continue;
        }
        if (made.shortened || made.length < kNoticedShort * wanted)
            outcome.warnings.push_back(short_extrusion(names[i], made, wanted));
        surface = made.surface;
        lengths.push_back(made.length);
        list += (list.empty() ? "" : ",") + names[i];
        report.push_back({{"name", names[i]},
                          {"length_mm", made.length},
                          {"diameter_mm", diameter},
                          {"shortened", made.shortened}});
    }
    tell_blocked(surface, blocked, arguments.has("opening") || lengths.empty(), outcome.warnings);
    if (!limited.empty())
        outcome.warnings.push_back(
            {.code = "extrusion-limited",
             .figures = {{"diameters", arguments.real("diameters")},
                         {"share", arguments.real("share")}},
             .words = {{"openings", enumerated(limited)}},
             .remedies = {{.arguments = {{"length", ""}}}, {.arguments = {{"share", ""}}}}});
    outcome.resolved.set("opening", list);
    outcome.resolved.set("lengths", lengths);
    outcome.report = std::make_shared<ordered_json>(ordered_json{{"openings", report}});
    outcome.scene = with_surface(scene, std::move(surface));
    return outcome;
}

/// Decided for each opening: shorter where another vessel is in the way.
Parameter lengths_parameter() {
    return {.name = "lengths",
            .type = ParameterType::List,
            .unit = "mm",
            .help =
                "the length at each opening, which may be shorter if another vessel is in "
                "the way",
            .use = Use::Decision};
}

StatedChange longer_vessels(const Scene&, const Outcome&) {
    return {.rims = kAnyGrowth};
}

}  // namespace

Operation extrude_opening_operation() {
    using enum ParameterType;
    return {.name = "extrude-opening",
            .usual_step = Step::Openings,
            .allowed = {Step::Openings, Step::Smoothing, Step::Deformation},
            .summary = "lengthen vessels straight at their openings",
            .parameters =
                {{.name = "opening",
                  .type = Text,
                  .help = "names of the openings, separated by commas; default: all",
                  .meaning = Meaning::Openings},
                 {.name = "diameters",
                  .unit = "-",
                  .default_value = 3.0,
                  .help = "length in diameters of the opening",
                  .minimum = 0.0,
                  .maximum = 100.0,
                  .above_minimum = true},
                 {.name = "share",
                  .unit = "-",
                  .default_value = 0.3,
                  .help = "limit of diameters: of the diagonal of the surface's bounding box",
                  .minimum = 0.0,
                  .maximum = 100.0,
                  .above_minimum = true,
                  .use = Use::Rare},
                 {.name = "length",
                  .unit = "mm",
                  .help = "length, whatever the diameters; default: by diameters",
                  .minimum = 0.0,
                  .above_minimum = true},
                 {.name = "direction",
                  .type = Choice,
                  .default_value = "normal",
                  .help = "normal: along the cap's normal; centerline: along the vessel's course "
                          "just before the cap, which stays parallel to itself",
                  .choices = {"normal", "centerline"}},
                 {.name = "profile",
                  .type = Choice,
                  .default_value = "circle",
                  .help = "circle: the section becomes a circle of the same area; keep: it is kept",
                  .choices = {"circle", "keep"}},
                 {.name = "blend",
                  .unit = "-",
                  .default_value = 0.5,
                  .help = "fraction of the length over which the section becomes a circle",
                  .minimum = 0.0,
                  .maximum = 1.0,
                  .above_minimum = true,
                  .only_with = Condition{"profile", {"circle"}},
                  .use = Use::Rare},
                 lengths_parameter()},
            .run = &extrude,
            .may_change = &longer_vessels,
            .thesis = "4.2.8",
            .example = {.scene = ExampleScene::Openings, .changed = {{"diameters", 1.0}}}};
}

}  // namespace vesselbench
