#include "meshing/remeshing/subdivide.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Surface after =
        subdivide(surface_of(scene), static_cast<int>(arguments.integer("iterations")), progress);
    Outcome outcome;
    outcome.resolved = arguments;
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

}  // namespace

Operation subdivide_operation() {
    return {.name = "subdivide",
            .usual_step = Step::Remeshing,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = "split every triangle into four and smooth (Loop); caps stay flat",
            .parameters = {{.name = "iterations",
                            .type = ParameterType::Integer,
                            .default_value = std::int64_t{1},
                            .help = "each one splits a triangle into four",
                            .minimum = 1,
                            .maximum = 6}},
            .run = &run,
            .thesis = "3.3.1",
            .search = {.parameters = &searched_parameters},
            .example = {.changed = {{"iterations", std::int64_t{2}}}}};
}

}  // namespace vesselbench
