#include "meshing/products/print_check.h"

#include <nlohmann/json.hpp>

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
        problems.push_back({{"cause", problem.cause},
                            {"count", problem.count},
                            {"places_mm", places},
                            {"remedy", problem.remedy}});
    }
    return problems;
}

std::string headline_of(const PrintCheck& check, bool thin) {
    std::string text = !check.printable() ? "not printable"
                       : thin             ? "printable with care"
                                          : "printable";
    if (check.lumen) text += formatted(check.lumen->distance, ", thinnest place %.2f mm");
    if (check.gap) text += formatted(check.gap->distance, ", smallest gap %.2f mm");
    return text;
}

void warn_if_below(const std::optional<FacingPlaces>& places, double limit, const std::string& what,
                   Outcome& outcome) {
    if (!places || places->distance >= limit) return;
    outcome.warnings.push_back(what + " is " + formatted(places->distance) + " mm, below " +
                               formatted(limit) + " mm, at " + place_text(places->from));
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
    outcome.warnings.push_back(
        formatted(bend->turn_deg, "the vessel turns by %.0f degrees within two diameters at ") +
        place_text(bend->place) + formatted(limit, ", above %.0f: a cast may break there") +
        " when it is taken out of its mold; straighten the branch, or do not cast it");
}

Outcome run_print_check(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const PrintCheck check = print_check(surface_of(scene), progress.part(0.0, 0.7));
    const std::optional<Bend> bend = bend_of(surface_of(scene), progress.part(0.7, 1.0));
    Outcome outcome;
    outcome.scene = scene;
    outcome.resolved = arguments;
    for (const SurfaceProblem& problem : check.problems)
        outcome.warnings.push_back(to_string(problem));
    warn_if_below(check.lumen, arguments.real("thinnest"), "the thinnest place of the model",
                  outcome);
    warn_if_below(check.gap, arguments.real("closest"), "the smallest gap between two branches",
                  outcome);
    warn_if_bent(bend, arguments.real("bend"), outcome);
    const bool thin = outcome.warnings.size() > check.problems.size();
    Json report = {{"headline", headline_of(check, thin)},
                   {"printable", check.printable()},
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
                            .help = "warn where opposite walls of the model are closer",
                            .minimum = 0.0,
                            .maximum = 100.0},
                           {.name = "closest",
                            .unit = "mm",
                            .default_value = 0.5,
                            .help = "warn where two branches are closer: they may fuse in print",
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
                                                       .about = "Check of the printable model."}}};
}

}  // namespace vesselbench
