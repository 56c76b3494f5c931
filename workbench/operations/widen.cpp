#include "geometry/vessel/repair/widen.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "smoothing/filters/new_crossings.h"
#include "workbench/case/point_json.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/shared/crossing_warning.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kVoxels = 0.5;  ///< default width, in the smallest voxel edge
constexpr double kLeft = 0.9;    ///< of the width: what is below it afterwards, is still narrow

/// Half a voxel: what is narrower, the image hardly shows.
double width_from_sampling(const Scene& scene) {
    if (!scene.sampling)
        throw DiagnosedFailure({.code = "width-unknown",
                                .operation = "widen",
                                .remedies = {{.arguments = {{"width", ""}}}}});
    return kVoxels * scene.sampling->spacing.minCoeff();
}

Arguments decided_width(const Scene& scene, const CheckedArguments&, const Progress&) {
    return {{"width", width_from_sampling(scene)}};
}

Diagnostic widened(const std::vector<NarrowPlace>& places, double width) {
    return {.code = "lumen-widened",
            .place = places.front().place,
            .figures = {{"limit_mm", width},
                        {"places", static_cast<double>(places.size())},
                        {"width_mm", places.front().width}}};
}

Diagnostic still_narrow(const std::vector<NarrowPlace>& places) {
    return {.code = "still-narrow",
            .place = places.front().place,
            .figures = {{"places", static_cast<double>(places.size())},
                        {"width_mm", places.front().width}},
            .remedies = {{.operation = "brush-inflate"}}};
}

Json places_json(const std::vector<NarrowPlace>& places) {
    Json all = Json::array();
    for (const auto& [place, width] : places)
        all.push_back({{"place_mm", point_json(place)}, {"width_mm", width}});
    return all;
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    if (!arguments.has("width")) outcome.resolved.set("width", width_from_sampling(scene));
    const double width = outcome.resolved.real("width");
    progress.report(0.0, "looking for narrow places");
    const std::vector<NarrowPlace> found = narrow_places(surface, width, progress);
    std::vector<NarrowPlace> left;
    outcome.scene = scene;
    if (!found.empty()) {
        Positions moved = widen(surface, width, progress.part(0.1, 0.7));
        warn_of_crossings(take_back_crossings(surface, moved, progress.part(0.7, 0.9)),
                          "widening-crosses-walls", {{.operation = "repair"}}, outcome);
        Surface after = surface.with_positions(std::move(moved));
        left = narrow_places(after, kLeft * width, progress);
        outcome.scene = with_surface(scene, std::move(after));
        outcome.warnings.push_back(widened(found, width));
        if (!left.empty()) outcome.warnings.push_back(still_narrow(left));
    }
    outcome.report = std::make_shared<Json>(
        Json{{"places", places_json(found)}, {"still_narrow", places_json(left)}});
    return outcome;
}

constexpr double kFolded = 0.005;  ///< where a thread alone is widened, nothing is folded [-]

StatedChange widened_lumen(const Scene&, const Outcome&) {
    return {.keeps_triangles = true,
            .folded = kFolded,
            .remedies = {{.arguments = {{"width", ""}}}, {.operation = "brush-inflate"}}};
}

}  // namespace

Operation widen_operation() {
    return {.name = "widen",
            .usual_step = Step::LocalRepair,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation},
            .summary =
                "widen the lumen where it is narrower than its image can show; each place "
                "is named",
            .parameters = {{.name = "width",
                            .type = ParameterType::Real,
                            .unit = "mm",
                            .help = "narrower places become this wide; default: half the smallest "
                                    "edge of the image's voxels",
                            .minimum = 0.0,
                            .above_minimum = true}},
            .run = &run,
            .decided = &decided_width,
            .may_change = &widened_lumen,
            .thesis = "4.2.4",
            .example = {.given = {{"width", 2.25}}, .changed = {{"width", 2.375}}}};
}

}  // namespace vesselbench
