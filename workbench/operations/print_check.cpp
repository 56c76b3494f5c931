#include "meshing/products/print_check.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
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

Outcome run_print_check(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const PrintCheck check = print_check(surface_of(scene), progress);
    Outcome outcome;
    outcome.scene = scene;
    outcome.resolved = arguments;
    for (const SurfaceProblem& problem : check.problems)
        outcome.warnings.push_back(to_string(problem));
    warn_if_below(check.lumen, arguments.real("thinnest"), "the thinnest place of the model",
                  outcome);
    warn_if_below(check.gap, arguments.real("closest"), "the smallest gap between two branches",
                  outcome);
    const bool thin = outcome.warnings.size() > check.problems.size();
    Json report = {{"headline", headline_of(check, thin)},
                   {"printable", check.printable()},
                   {"unit", "mm"},
                   {"size_mm", point_json(check.size)}};
    report.update(extent_json(check.volume, check.area));
    report.update({{"smallest_wall_distance", facing_json(check.lumen)},
                   {"smallest_gap", facing_json(check.gap)},
                   {"problems", problems_json(check)}});
    outcome.report = std::make_shared<Json>(std::move(report));
    return outcome;
}

}  // namespace

Operation print_check_operation() {
    return {.name = "print-check",
            .usual_step = Step::Product,
            .allowed = {Step::Product},
            .summary = "check the model for printing: watertight, thin places, narrow gaps",
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
                            .maximum = 100.0}},
            .run = &run_print_check,
            .thesis = "2.3",
            .recipe = {.report_section = ReportSection{.key = "print",
                                                       .title = "Print",
                                                       .about = "Check of the printable model."}}};
}

}  // namespace vesselbench
