#include "meshing/tetrahedra/tetrahedralize.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "meshing/layers/layered_mesh.h"
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
    if (mesh.prisms.empty()) return patches;
    for (std::size_t k = 0; k < mesh.patches.size(); ++k)
        patches[k]["quadrilaterals"] =
            std::count(mesh.side_patches.begin(), mesh.side_patches.end(), k);
    return patches;
}

std::string headline(const VolumeQuality& quality) {
    std::string text = counted(quality.cells - quality.prisms, "tetrahedron", "tetrahedra");
    if (quality.prisms > 0) text += " and " + counted(quality.prisms, "prism", "prisms");
    return text + formatted(quality.smallest_dihedral, ", smallest dihedral angle %.1f deg");
}

Json layers_json(const LayerReport& report) {
    Json places = Json::array();
    for (const ThinPlace& thin : report.places)
        places.push_back({{"place", {thin.place.x(), thin.place.y(), thin.place.z()}},
                          {"thickness_mm", thin.thickness},
                          {"share", thin.share}});
    return {{"layers", report.layers},
            {"prisms", report.prisms},
            {"covered_percent", 100.0 * report.covered},
            {"wished_mm", report.wished},
            {"thickness_mm", report.thickness},
            {"thinnest_mm", report.thinnest},
            {"first_mm", report.first},
            {"limited_percent", 100.0 * report.limited},
            {"below_half_percent", 100.0 * report.half},
            {"steep_percent", 100.0 * report.steep},
            {"thin_places", places}};
}

Json report_json(const VolumeMesh& mesh, const TetrahedralizeReport& report) {
    return {{"headline", headline(report.quality)},
            {"cells", report.quality.cells},
            {"size_factor", report.size},
            {"tetgen_switches", report.switches},
            {"tetgen_attempts", report.attempts},
            {"surface_kept", report.surface_kept},
            {"patches", patches_json(mesh)},
            {"quality", volume_quality_json(report.quality)},
            {"quality_before_improvement", volume_quality_json(report.raw)}};
}

LayerParameters layers_from(const Arguments& arguments) {
    LayerParameters layers{.layers = static_cast<int>(arguments.integer("layers")),
                           .growth = arguments.real("layer_growth"),
                           .thickness = arguments.real("layer_thickness"),
                           .thickness_mm = arguments.optional_real("layer_thickness_mm"),
                           .first = arguments.optional_real("layer_first")};
    if (layers.first && layers.thickness_mm)
        throw UsageError(
            "tetrahedralize: layer_first and layer_thickness_mm exclude each other: layer_growth "
            "makes the thickness of one from the other");
    return layers;
}

// A larger share of the wall than this with layers of less than half their thickness is noticed.
constexpr double kNoticedShare = 0.03;

void warn_of_thin_layers(const LayerReport& layers, std::vector<Diagnostic>& warnings) {
    if (layers.half <= kNoticedShare || layers.places.empty()) return;
    warnings.push_back({.code = "layers-limited",
                        .place = layers.places.front().place,
                        .figures = {{"percent", 100.0 * layers.half},
                                    {"wished", layers.wished},
                                    {"thinnest", layers.thinnest}}});
}

Outcome tetrahedralize(const Scene& scene, const Arguments& arguments, Progress& progress) {
    TetrahedralizeParameters parameters;
    parameters.cells = arguments.optional_real("cells");
    parameters.size = arguments.real("size");
    parameters.growth = arguments.real("growth");
    parameters.quality = arguments.real("quality");
    parameters.improve = static_cast<int>(arguments.integer("improve"));
    const LayerParameters layers = layers_from(arguments);
    Outcome outcome;
    LayeredMesh result;
    if (layers.layers > 0) {
        result = layered_mesh(surface_of(scene), parameters, layers, progress);
    } else {
        TetrahedralizeResult plain = tetrahedralized(surface_of(scene), parameters, progress);
        result = {.mesh = std::move(plain.mesh), .report = std::move(plain.report)};
    }
    Json report = report_json(result.mesh, result.report);
    outcome.warnings = result.report.warnings;
    if (layers.layers > 0) {
        report["layers"] = layers_json(result.layers);
        warn_of_thin_layers(result.layers, outcome.warnings);
    }
    outcome.report = std::make_shared<Json>(std::move(report));
    outcome.resolved = arguments;
    outcome.resolved.remove("cells");
    outcome.resolved.set("size", result.report.size);
    outcome.scene = scene;
    outcome.scene.volume_mesh = std::make_shared<const VolumeMesh>(std::move(result.mesh));
    return outcome;
}

}  // namespace

Operation tetrahedralize_operation() {
    using enum ParameterType;
    const TetrahedralizeParameters d;
    const LayerParameters layers;
    return {
        .name = "tetrahedralize",
        .usual_step = Step::Product,
        .allowed = {Step::Product},
        .summary =
            "fill the closed, remeshed surface with cells for a flow solver: tetrahedra, and "
            "layers of "
            "prisms along the wall if asked",
        .parameters = {{.name = "cells",
                        .unit = "-",
                        .help = "target number of cells, met within 10 % if the surface "
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
                       {.name = "layers",
                        .type = Integer,
                        .default_value = std::int64_t{layers.layers},
                        .help = "layers of prisms along the wall, where the shear is; 0: none",
                        .minimum = 0,
                        .maximum = 20},
                       {.name = "layer_thickness",
                        .unit = "-",
                        .default_value = layers.thickness,
                        .help = "thickness of all layers together by the vessel's radius there; "
                                "less where walls are close or curved",
                        .minimum = 0.01,
                        .maximum = 0.45},
                       {.name = "layer_thickness_mm",
                        .unit = "mm",
                        .help = "the same as a length; default: by layer_thickness",
                        .minimum = 1e-4,
                        .maximum = 20.0},
                       {.name = "layer_growth",
                        .unit = "-",
                        .default_value = layers.growth,
                        .help = "height of a layer by that of the next one towards the wall",
                        .minimum = 1.0,
                        .maximum = 2.0},
                       {.name = "layer_first",
                        .unit = "mm",
                        .help = "height of the layer at the wall; default: by the thickness",
                        .minimum = 1e-5,
                        .maximum = 5.0},
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
