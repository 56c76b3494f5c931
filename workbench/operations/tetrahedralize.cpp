#include "meshing/tetrahedra/tetrahedralize.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/measure_json.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json patches_json(const VolumeMesh& mesh) {
    Json patches = Json::array();
    for (std::size_t k = 0; k < mesh.patches.size(); ++k)
        patches.push_back({{"name", mesh.patches[k].name},
                           {"kind", to_string(mesh.patches[k].kind)},
                           {"triangles", std::count(mesh.boundary_patches.begin(),
                                                    mesh.boundary_patches.end(), k)}});
    return patches;
}

Json report_json(const TetrahedralizeResult& result) {
    const TetrahedralizeReport& report = result.report;
    return {{"headline",
             counted(report.quality.cells, "tetrahedron", "tetrahedra") +
                 formatted(report.quality.smallest_dihedral, ", smallest dihedral angle %.1f deg")},
            {"cells", report.quality.cells},
            {"size_factor", report.size},
            {"tetgen_switches", report.switches},
            {"tetgen_attempts", report.attempts},
            {"surface_kept", report.surface_kept},
            {"patches", patches_json(result.mesh)},
            {"quality", volume_quality_json(report.quality)},
            {"quality_before_improvement", volume_quality_json(report.raw)}};
}

Outcome tetrahedralize(const Scene& scene, const Arguments& arguments, Progress& progress) {
    TetrahedralizeParameters parameters;
    parameters.cells = arguments.optional_real("cells");
    parameters.size = arguments.real("size");
    parameters.growth = arguments.real("growth");
    parameters.quality = arguments.real("quality");
    parameters.improve = static_cast<int>(arguments.integer("improve"));
    TetrahedralizeResult result = tetrahedralized(surface_of(scene), parameters, progress);
    Outcome outcome;
    outcome.report = std::make_shared<Json>(report_json(result));
    outcome.resolved = arguments;
    outcome.resolved.remove("cells");
    outcome.resolved.set("size", result.report.size);
    outcome.warnings = result.report.warnings;
    outcome.scene = scene;
    outcome.scene.volume_mesh = std::make_shared<const VolumeMesh>(std::move(result.mesh));
    return outcome;
}

}  // namespace

Operation tetrahedralize_operation() {
    using enum ParameterType;
    const TetrahedralizeParameters d;
    return {
        .name = "tetrahedralize",
        .usual_step = Step::Product,
        .allowed = {Step::Product},
        .summary = "fill the closed, remeshed surface with tetrahedra for a flow solver",
        .parameters = {{.name = "cells",
                        .unit = "-",
                        .help = "target number of tetrahedra, met within 10 % if the surface "
                                "allows it; default: determined by `size`",
                        .minimum = 100.0,
                        .maximum = 1e8},
                       {.name = "size",
                        .unit = "-",
                        .default_value = d.size,
                        .help = "edge length in the lumen relative to that of the surface nearby",
                        .minimum = 0.05,
                        .maximum = 20.0},
                       {.name = "growth",
                        .unit = "-",
                        .default_value = d.growth,
                        .help = "growth of the edge length per distance from the wall; 0 keeps the "
                                "surface's edge length throughout",
                        .minimum = 0.0,
                        .maximum = 1.0},
                       {.name = "quality",
                        .unit = "-",
                        .default_value = d.quality,
                        .help = "largest ratio of a tetrahedron's circumradius to its shortest "
                                "edge in TetGen; smaller is better and finer",
                        .minimum = 1.1,
                        .maximum = 5.0,
                        .use = Use::Rare},
                       {.name = "improve",
                        .type = Integer,
                        .default_value = std::int64_t{d.improve},
                        .help = "rounds of moving inner vertices and exchanging edges after "
                                "TetGen; 0: none",
                        .minimum = 0,
                        .maximum = 50,
                        .use = Use::Rare}},
        .run = &tetrahedralize,
        .isolated = true,
        .thesis = "3.3.3",
        .recipe = {.makes_volume_mesh = true},
        .example = {.changed = {{"growth", 0.3}}}};
}

}  // namespace vesselbench
