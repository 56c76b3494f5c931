#include "meshing/remeshing/subdivide.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "meshing/remeshing/local_subdivide.h"
#include "workbench/operations/shared/near_place.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

Surface near_subdivided(const Surface& surface, int iterations, Outcome& outcome,
                        const Progress& progress) {
    const SurfaceDistance places = distance_to(surface);
    const auto near = near_place(surface, places, outcome.resolved);
    return subdivide_near(surface, places, *near, iterations, progress);
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Outcome outcome;
    outcome.resolved = arguments;
    const Surface& surface = surface_of(scene);
    const auto iterations = static_cast<int>(arguments.integer("iterations"));
    Surface after = arguments.has("at") ? near_subdivided(surface, iterations, outcome, progress)
                                        : subdivide(surface, iterations, progress);
    outcome.report = std::make_shared<nlohmann::ordered_json>(
        nlohmann::ordered_json{{"mean_edge_mm", mean_edge_length(after)}});
    outcome.scene = with_surface(scene, std::move(after));
    return outcome;
}

std::vector<SearchedParameter> searched_parameters(const Surface& surface, bool) {
    SearchedParameter iterations{
        .name = "iterations", .values = {0.0, 1.0}, .coarse = 1, .idle = 0.0};
    auto triangles = 16.0 * static_cast<double>(surface.triangle_count());
    for (int i = 2; i <= 3 && triangles <= kMostSearchedTriangles; ++i, triangles *= 4.0)
        iterations.values.push_back(i);
    return {iterations};
}

std::vector<Parameter> subdivide_parameters() {
    std::vector<Parameter> table = {{.name = "iterations",
                                     .type = ParameterType::Integer,
                                     .default_value = std::int64_t{1},
                                     .help = "each one splits a triangle into four",
                                     .minimum = 1,
                                     .maximum = 6}};
    for (Parameter& parameter : near_parameters("subdivide")) table.push_back(std::move(parameter));
    return table;
}

}  // namespace

Operation subdivide_operation() {
    return {.name = "subdivide",
            .usual_step = Step::Remeshing,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = "split every triangle into four and smooth (Loop); caps stay flat",
            .parameters = subdivide_parameters(),
            .run = &run,
            .may_change = &kept_vessels_and_sacs,
            .thesis = "3.3.1, 4.2.5",
            .search = {.parameters = &searched_parameters},
            .example = {.changed = {{"iterations", std::int64_t{2}}}}};
}

}  // namespace vesselbench
