#include "meshing/products/print_check.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/bends.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "workbench/case/measure_json.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json facing_json(const std::optional<FacingPlaces>& places) {
    if (!places) return nullptr;
    return {{"distance_mm", places->distance},
            {"from_mm", point_json(places->from)},
            {"to_mm", point_json(places->to)}};
}

Json problems_json(const PrintCheck& check) {
    Json problems = Json::array();
    for (const SurfaceProblem& problem : check.problems) {
        Json places = Json::array();
        for (const Vec3& p : problem.places) places.push_back(point_json(p));
        const Diagnostic found = diagnostic_of(problem);
        problems.push_back({{"code", found.code},
                            {"text", text_of(found)},
                            {"count", problem.count},
                            {"places_mm", places}});
    }
    return problems;
}

std::string headline_of(const PrintCheck& check, double thinnest, double closest) {
    std::string text = !check.is_watertight()                   ? "not watertight"
                       : !check.is_printable(thinnest, closest) ? "not printable"
                                                                : "printable";
    const auto add = [&](const auto& places, const char* what, double limit) {
        if (!places) return;
        text += what + formatted(places->distance, "%.2f mm");
        if (places->distance < limit) text += ", below " + formatted(limit) + " mm";
    };
    add(check.lumen, ", thinnest place ", thinnest);
    add(check.gap, ", smallest gap ", closest);
    return text;
}

/// \param code "thin-place" or "narrow-gap"
void warn_if_below(const std::optional<FacingPlaces>& places, double limit, const char* code,
                   Outcome& outcome) {
    if (!places || places->distance >= limit) return;
    outcome.warnings.push_back(
        {.code = code,
         .place = places->from,
         .figures = {{"distance_mm", places->distance}, {"limit_mm", limit}}});
}

/// The strongest bend of a vessel; none of a body without centerlines.
std::optional<Bend> bend_of(const Surface& surface, const Progress& progress) {
    try {
        return strongest_bend(*centerlines_of(surface, {}, progress));
    } catch (const AlgorithmFailure&) {
        return std::nullopt;
    } catch (const InvalidInput&) {
        return std::nullopt;
    }
}

Json bend_json(const std::optional<Bend>& bend) {
    if (!bend) return nullptr;
    return {{"turn_deg", bend->turn_deg},
            {"radius_mm", bend->radius},
            {"place_mm", point_json(bend->place)}};
}

void warn_if_bent(const std::optional<Bend>& bend, double limit, Outcome& outcome) {
    if (!bend || bend->turn_deg <= limit) return;
    outcome.warnings.push_back({.code = "cast-may-break",
                                .place = bend->place,
                                .figures = {{"turn_deg", bend->turn_deg}, {"limit_deg", limit}}});
}

Outcome run_print_check(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const PrintCheck check = print_check(surface_of(scene), progress.part(0.0, 0.7));
    const std::optional<Bend> bend = bend_of(surface_of(scene), progress.part(0.7, 1.0));
    Outcome outcome;
    outcome.scene = scene;
    outcome.resolved = arguments;
    for (const SurfaceProblem& problem : check.problems)
        outcome.warnings.push_back(diagnostic_of(problem));
    const double thinnest = arguments.real("thinnest"), closest = arguments.real("closest");
    warn_if_below(check.lumen, thinnest, "thin-place", outcome);
    warn_if_below(check.gap, closest, "narrow-gap", outcome);
    warn_if_bent(bend, arguments.real("bend"), outcome);
    Json report = {{"headline", headline_of(check, thinnest, closest)},
                   {"printable", check.is_printable(thinnest, closest)},
                   {"watertight", check.is_watertight()},
                   {"unit", "mm"},
                   {"size_mm", point_json(check.size)}};
    report.update(extent_json(check.volume, check.area));
    report.update({{"smallest_wall_distance", facing_json(check.lumen)},
                   {"smallest_gap", facing_json(check.gap)},
                   {"strongest_bend", bend_json(bend)},
                   {"problems", problems_json(check)}});
    outcome.report = std::make_shared<Json>(std::move(report));
    return outcome;
}

}  // namespace

Operation print_check_operation() {
    return {.name = "print-check",
            .usual_step = Step::Product,
            .allowed = {Step::Product},
            .summary =
                "check the model for printing: watertight, thin places, narrow gaps, "
                "strong bends",
            .parameters = {{.name = "thinnest",
                            .unit = "mm",
                            .default_value = 0.8,
                            .help = "not printable, with a warning, where walls are closer",
                            .minimum = 0.0,
                            .maximum = 100.0},
                           {.name = "closest",
                            .unit = "mm",
                            .default_value = 0.5,
                            .help = "the same for two branches: they may fuse in print",
                            .minimum = 0.0,
                            .maximum = 100.0},
                           {.name = "bend",
                            .unit = "deg",
                            .default_value = 75.0,
                            .help = "warn where a vessel turns by more within two diameters: casts "
                                    "break there; 57 is a bend of radius two vessel radii",
                            .minimum = 0.0,
                            .maximum = 180.0}},
            .run = &run_print_check,
            .thesis = "2.3",
            .recipe = {.report_section = ReportSection{.key = "print",
                                                       .title = "Print",
                                                       .about = "Check of the printable model."}},
            .example = {.changed = {{"bend", 60.0}}}};
}

}  // namespace vesselbench
