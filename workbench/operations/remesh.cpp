#include "meshing/remeshing/remesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "meshing/remeshing/feature_regions.h"
#include "meshing/remeshing/local_radius.h"
#include "meshing/remeshing/local_remesh.h"
#include "meshing/remeshing/sizing_field.h"
#include "workbench/case/measure_json.h"
#include "workbench/operations/shared/near_place.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

constexpr double kNoticedVolume = 0.03;  ///< [-]

RemeshParameters parameters_from(const Arguments& arguments) {
    const auto least = arguments.optional_real("min_edge"),
               most = arguments.optional_real("max_edge");
    if (least && most && *least > *most)
        throw UsageError("remesh: min_edge = " + to_text(*least) +
                         " mm is above max_edge = " + to_text(*most) + " mm");
    return {.mode = arguments.text("mode") == "uniform" ? RemeshMode::Uniform : RemeshMode::Graded,
            .edge = arguments.optional_real("edge"),
            .min_edge = arguments.optional_real("min_edge"),
            .max_edge = arguments.optional_real("max_edge"),
            .gradation = arguments.real("gradation"),
            .cells = arguments.optional_real("cells"),
            .resolution = arguments.real("print_resolution"),
            .hold_resolution = arguments.flag("hold_resolution")};
}

Report report_from(const RemeshReport& figures, const std::optional<FeatureRegions>& features) {
    nlohmann::ordered_json report = {{"usual_radius_mm", figures.usual_radius},
                                     {"edge_mm", figures.edge},
                                     {"wall", triangle_shape_json(figures.wall)},
                                     {"caps", triangle_shape_json(figures.caps)}};
    if (features) report["feature_edges_kept"] = features->edges;
    return std::make_shared<nlohmann::ordered_json>(std::move(report));
}

/// The centerlines, if they are wanted and can be found; the source used is resolved.
std::shared_ptr<const CenterlineGraph> centerlines(const Surface& surface, Outcome& outcome,
                                                   const Progress& progress) {
    if (outcome.resolved.text("radius") != "centerlines") return nullptr;
    std::string reason;
    try {
        return centerlines_of(surface, {}, progress);
    } catch (const AlgorithmFailure& failure) {
        reason = failure.what();
    } catch (const InvalidInput& failure) {
        reason = failure.what();
    }
    outcome.resolved.set("radius", std::string("rays"));
    outcome.warnings.push_back({.code = "radius-by-rays", .words = {{"reason", reason}}});
    return nullptr;
}

/// An opening shows with so many edges to its diameter.
constexpr double kEdgesAcross = 4.0;

/// \throw AlgorithmFailure if a cap collapsed: its vessel's end would be wall
void require_openings(const Surface& before, const Surface& after, double edge) {
    for (std::size_t p = 0; p < before.patches.size(); ++p) {
        const auto has = [p](const Surface& surface) {
            return std::ranges::find(*surface.patch_labels, p) != surface.patch_labels->end();
        };
        if (before.patches[p].kind == PatchKind::Wall || !has(before) || has(after)) continue;
        const double diameter = patch_shape(before, p).diameter();
        throw DiagnosedFailure(
            {.code = "opening-lost",
             .operation = "remesh",
             .place = patch_shape(before, p).plane.point,
             .figures = {{"edge_mm", edge}, {"diameter_mm", diameter}},
             .words = {{"opening", before.patches[p].name}},
             .remedies = {
                 {.arguments = {{"min_edge", formatted(diameter / kEdgesAcross, "%.2g")}}}}});
    }
}

void add_warnings(const RemeshReport& figures, Outcome& outcome) {
    const std::vector<Remedy> another_edge = {{.arguments = {{"edge", ""}}}};
    if (figures.limited)
        outcome.warnings.push_back({.code = "edges-limited",
                                    .figures = {{"edge_mm", figures.edge}},
                                    .remedies = another_edge});
    if (figures.cells > 0.0)
        outcome.warnings.push_back(
            {.code = "edges-for-cells",
             .figures = {{"edge_mm", figures.edge},
                         {"millions", figures.cells / 1e6},
                         {"around", 2.0 * std::numbers::pi * figures.usual_radius / figures.edge}},
             .remedies = {{.arguments = {{"cells", ""}}}, {.arguments = {{"edge", ""}}}}});
    if (figures.crossings_parted > 0)
        outcome.warnings.push_back(
            {.code = "crossings-parted", .place = figures.crossing, .remedies = another_edge});
    if (const auto& off = figures.beyond_resolution)
        outcome.warnings.push_back({.code = "beyond-resolution",
                                    .place = off->place,
                                    .figures = {{"off_mm", off->distance}},
                                    .remedies = another_edge});
    if (std::abs(figures.volume_change) > kNoticedVolume)
        outcome.warnings.push_back({.code = "edges-coarse",
                                    .figures = {{"edge_mm", figures.edge},
                                                {"volume_percent", 100.0 * figures.volume_change}},
                                    .remedies = another_edge});
}

/// An edge length that was asked for is no subject of the printer's resolution.
void resolve_resolution(const Arguments& given, Arguments& resolved) {
    if (given.has("edge") || given.text("mode") == "uniform") resolved.set("print_resolution", 0.0);
}

/// Of a print, the resolution is what was decided.
void resolve_edges(const RemeshReport& figures, Arguments& resolved) {
    if (resolved.real("print_resolution") > 0.0) return;
    resolved.set("edge", figures.edge);
    if (resolved.text("mode") != "graded") return;
    resolved.set("min_edge", figures.min_edge);
    resolved.set("max_edge", figures.max_edge);
}

/// Around a place, the triangles beside it decide how their size changes.
void refuse_what_is_of_the_whole(const Arguments& arguments) {
    for (const char* name : {"min_edge", "max_edge", "cells", "feature_angle"})
        if (arguments.has(name))
            throw UsageError("remesh: " + std::string(name) +
                             " is of the whole wall, and has no effect with at");
}

Outcome run_near(const Scene& scene, const Arguments& arguments, const Progress& progress) {
    refuse_what_is_of_the_whole(arguments);
    const Surface& surface = surface_of(scene);
    const SurfaceDistance places = distance_to(surface);
    Outcome outcome;
    outcome.resolved = arguments;
    const auto near = near_place(surface, places, outcome.resolved);
    LocalRemeshed remeshed =
        remesh_near(surface, places, *near, arguments.optional_real("edge"), progress);
    const LocalRemeshReport& figures = remeshed.report;
    require_openings(surface, remeshed.surface, figures.edge);
    outcome.resolved.set("edge", figures.edge);
    outcome.report = std::make_shared<nlohmann::ordered_json>(
        nlohmann::ordered_json{{"edge_mm", figures.edge},
                               {"edge_before_mm", figures.edge_before},
                               {"reach_mm", figures.reach},
                               {"triangles_replaced", figures.replaced},
                               {"triangles_new", figures.replacement}});
    outcome.scene = with_surface(scene, std::move(remeshed.surface));
    return outcome;
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    if (arguments.has("at")) return run_near(scene, arguments, progress);
    const Surface& surface = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    const auto lines = centerlines(surface, outcome, progress.part(0.0, 0.3));
    resolve_resolution(arguments, outcome.resolved);
    std::optional<FeatureRegions> features;
    if (const auto angle = arguments.optional_real("feature_angle"))
        features = split_at_features(surface, *angle, arguments.real("feature_size"));
    Remeshed remeshed =
        remesh(features ? features->surface : surface, parameters_from(outcome.resolved),
               lines.get(), progress.part(0.3, 1.0));
    if (features) remeshed.surface = features->restored(remeshed.surface);
    require_openings(surface, remeshed.surface, remeshed.report.edge);
    const RemeshReport& figures = remeshed.report;
    resolve_edges(figures, outcome.resolved);
    outcome.report = report_from(figures, features);
    add_warnings(figures, outcome);
    outcome.scene = with_surface(scene, std::move(remeshed.surface));
    return outcome;
}

Arguments decided_remeshing(const Scene& scene, const CheckedArguments& arguments,
                            const Progress& progress) {
    const Surface& surface = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    if (const auto near = near_place(surface, distance_to(surface), outcome.resolved)) {
        if (!arguments->has("edge")) outcome.resolved.set("edge", near->within / kEdgesPerRadius);
        return outcome.resolved;
    }
    const auto lines = centerlines(surface, outcome, progress.part(0.0, 0.5));
    resolve_resolution(arguments, outcome.resolved);
    resolve_edges(decided_edges(surface, parameters_from(outcome.resolved), lines.get(),
                                progress.part(0.5, 1.0)),
                  outcome.resolved);
    return outcome.resolved;
}

/// The edge that print_resolution, or the range of edges, has made.
double edge_made(const Surface&, const Surface& after) {
    return three_digits(mean_edge_length(after));
}

std::vector<SearchedParameter> searched_parameters(const Surface& surface, bool all) {
    const double radius = usual_radius(surface, local_radii(surface, nullptr));
    SearchedParameter edge{.name = "edge", .values = {}, .coarse = 3, .value_if_open = &edge_made};
    for (const double factor :  // 45 ... 9 triangles around; the operation's 0.28 gives 22
         {0.14, 0.17, 0.2, 0.24, 0.28, 0.33, 0.4, 0.5, 0.6, 0.7}) {
        const double length = three_digits(factor * radius);
        const double triangle = std::sqrt(3.0) / 4.0 * length * length;
        if (area(surface) / triangle <= kMostSearchedTriangles) edge.values.push_back(length);
    }
    if (edge.values.empty())
        throw InvalidInput(
            "remesh: the vessel is so thin for its area that every candidate edge length would "
            "make more than 4 million triangles");
    if (!all) {
        edge.values.insert(edge.values.begin(), 0.0);
        edge.idle = 0.0;  // the surface's own triangles may be better than any result
        return {edge};
    }
    return {edge, {.name = "gradation", .values = {1.1, 1.2, 1.3, 1.5, 1.75, 2.0, 2.5, 3.0}}};
}

const Condition& when_graded() {
    static const Condition condition{"mode", {"graded"}};
    return condition;
}

std::vector<Parameter> edge_parameters() {
    using enum ParameterType;
    return {
        {.name = "mode",
         .type = Choice,
         .default_value = "graded",
         .help = "graded: smaller where the vessel is thin, curved, or close to another wall; "
                 "uniform: one edge length",
         .choices = {"graded", "uniform"}},
        {.name = "edge",
         .unit = "mm",
         .help =
             "edge length at the vessel's typical radius (the median over the wall); "
             "default: 0.28 of that radius, which is 22 triangles around; with at: a quarter of "
             "within",
         .minimum = 0.0,
         .above_minimum = true},
        {.name = "min_edge",
         .unit = "mm",
         .help = "shortest edge; default: a fifth of edge, or shorter where the vessel is so thin",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = when_graded()},
        {.name = "max_edge",
         .unit = "mm",
         .help = "longest edge; default: twice edge",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = when_graded()},
        {.name = "cells",
         .unit = "-",
         .help = "unless edge is given: so many tetrahedra may fill the lumen; edges become longer "
                 "for it, down to 12 around the typical vessel; models for flow use 1000000",
         .minimum = 1000.0,
         .maximum = 1e8,
         .only_with = when_graded()},
        {.name = "radius",
         .type = Choice,
         .default_value = "centerlines",
         .help = "source of the vessel's radius: centerlines, or rays across the lumen "
                 "(faster; also used if no centerlines can be found)",
         .choices = {"centerlines", "rays"},
         .use = Use::Rare},
        {.name = "gradation",
         .unit = "-",
         .default_value = 1.5,
         .help = "largest ratio of neighbouring edge lengths",
         .minimum = 1.05,
         .maximum = 3.0,
         .only_with = when_graded(),
         .use = Use::Rare}};
}

/// What is seldom needed.
std::vector<Parameter> other_parameters() {
    return {
        {.name = "feature_angle",
         .unit = "deg",
         .help = "also keep sharp edges, which bend by more than this (90: a cube's) and "
                 "surround a region; default: only the rims of patches",
         .minimum = 0.0,
         .maximum = 180.0,
         .above_minimum = true,
         .use = Use::Rare},
        {.name = "feature_size",
         .unit = "mm2",
         .default_value = 0.0,
         .help = "area from which on a region's edges are kept",
         .minimum = 0.0,
         .only_with = Condition{"feature_angle"},
         .use = Use::Rare},
        {.name = "print_resolution",
         .unit = "mm",
         .default_value = 0.0,
         .help = "a print needs no triangles for less deviation than this: unless edge is given, "
                 "edges are as long as it allows, at most 0.7 of the radius; 0: no print; "
                 "models for printing use 0.1",
         .minimum = 0.0,
         .maximum = 10.0,
         .only_with = when_graded(),
         .use = Use::Rare},
        {.name = "hold_resolution",
         .type = ParameterType::Flag,
         .default_value = false,
         .help = "edges become shorter where the surface would be off by more than "
                 "print_resolution; models for printing use it",
         .only_with = Condition{"print_resolution"},
         .use = Use::Rare}};
}

std::vector<Parameter> remesh_parameters() {
    std::vector<Parameter> table = edge_parameters();
    for (Parameter& parameter : near_parameters("remesh")) table.push_back(std::move(parameter));
    for (Parameter& parameter : other_parameters()) table.push_back(std::move(parameter));
    return table;
}

}  // namespace

Operation remesh_operation() {
    return {
        .name = "remesh",
        .usual_step = Step::Remeshing,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation, Step::Remeshing},
        .summary =
            "remesh the surface with well-shaped triangles; rims, flat caps and patches are kept",
        .parameters = remesh_parameters(),
        .run = &run,
        .decided = &decided_remeshing,
        .may_change = &kept_vessels,
        .thesis = "3.3.2, 4.2.5, 4.2.8-4.2.9",
        .search = {.parameters = &searched_parameters,
                   .rivals = {"min_edge", "max_edge"},
                   .counts_triangles = true},
        .example = {.given = {{"radius", std::string("rays")}},
                    .changed = {{"mode", std::string("uniform")}}}};
}

}  // namespace vesselbench
