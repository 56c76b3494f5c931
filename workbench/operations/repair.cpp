#include "geometry/vessel/repair/repair.h"

#include <algorithm>
#include <functional>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/flat_caps.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/bodies.h"
#include "workbench/operations/shared/handle_warnings.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// At most this many places of each kind of repair are listed; all are counted.
constexpr std::size_t kMostPlaces = 50;

/// At most this many closed holes have a warning of their own.
constexpr std::size_t kMostNamed = 5;

/// A removed piece of more than this fraction of the triangles [-] causes a warning.
constexpr double kWorthAWarning = 0.01;

/// Choices of the parameter `wall`.
constexpr const char* kLumen = "lumen";
constexpr const char* kOuter = "outer";
constexpr const char* kAskWall = "ask";

/// Of a wall with two sides, which one is the vessel depends on what the file means.
void ask_about_wall(const RepairReport& report) {
    if (report.removed_outer_wall)
        throw DiagnosedUsage(
            {.code = "wall-has-two-sides",
             .operation = "repair",
             .remedies = {{.arguments = {{"wall", kLumen}}}, {.arguments = {{"wall", kOuter}}}}});
}

ordered_json places_json(const std::vector<RepairPlace>& places) {
    ordered_json by_kind = ordered_json::object();
    for (const RepairPlace& place : places) {
        ordered_json& list = by_kind[to_string(place.kind)];
        if (list.size() < kMostPlaces)
            list.push_back({{"position_mm", point_json(place.position)}, {"size_mm", place.size}});
    }
    return by_kind;
}

ordered_json openings_json(const std::vector<KeptOpening>& openings) {
    ordered_json list = ordered_json::array();
    for (const KeptOpening& opening : openings)
        list.push_back({{"centre_mm", point_json(opening.centre)},
                        {"radius_mm", opening.radius},
                        {"edges", opening.edges}});
    return list;
}

/// What was found, in one line.
std::string headline_of(const RepairReport& report) {
    std::vector<std::string> parts;
    const auto add = [&](std::size_t count, const char* noun, const char* verb) {
        if (count > 0) parts.push_back(counted(count, noun) + " " + verb);
    };
    add(report.turned_triangles, "triangle", "flipped");
    add(report.removed_components, "stray part", "removed");
    add(report.self_intersections, "self-intersection", "removed");
    add(report.closed_holes, "hole", "closed");
    return joined(parts);
}

ordered_json report_json(const RepairReport& report) {
    return {{"headline", headline_of(report)},
            {"changed", report.changed()},
            {"welded_vertices", report.welded_vertices},
            {"unused_vertices", report.unused_vertices},
            {"degenerate_triangles", report.degenerate_triangles},
            {"duplicate_triangles", report.duplicate_triangles},
            {"removed_components", report.removed_components},
            {"removed_component_triangles", report.removed_component_triangles},
            {"non_manifold_edges", report.non_manifold_edges},
            {"non_manifold_vertices", report.non_manifold_vertices},
            {"turned_triangles", report.turned_triangles},
            {"turned_inside_out", report.turned_inside_out},
            {"self_intersections", report.self_intersections},
            {"smoothed_vertices", report.smoothed_vertices},
            {"refilled_triangles", report.refilled_triangles},
            {"closed_holes", report.closed_holes},
            {"collapsed_edges", report.collapsed_edges},
            {"flipped_edges", report.flipped_edges},
            {"openings", openings_json(report.openings)},
            {"places", places_json(report.places)}};
}

void add_closed_ends(std::vector<ClosedHole> ends, std::vector<Diagnostic>& warnings) {
    std::ranges::stable_sort(ends, std::greater{}, &ClosedHole::radius);
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i == kMostNamed)
            return warnings.push_back(
                {.code = "more-holes-closed",
                 .figures = {{"holes", static_cast<double>(ends.size() - i)}}});
        const ClosedHole& end = ends[i];
        warnings.push_back(
            {.code = end.in_wall ? "hole-in-wall-closed" : "vessel-end-closed",
             .place = end.centre,
             .figures = {{"width_mm", 2.0 * end.radius}, {"lumen_mm", 2.0 * end.lumen_radius}},
             .remedies = {{.arguments = {{"close_holes_up_to", formatted(0.9 * end.radius)}}}}});
    }
}

/// What was removed of a surface; none: nothing that matters.
std::optional<Diagnostic> removal_warning(const RepairReport& report, const Surface& before) {
    const auto pieces = static_cast<double>(report.removed_components);
    const auto triangles = static_cast<double>(report.removed_component_triangles);
    if (const auto& vessel = report.removed_vessel)
        return Diagnostic{
            .code = "vessel-removed",
            .place = vessel->centre,
            .figures = {{"pieces", pieces},
                        {"length_mm", vessel->length},
                        {"diameter_mm", vessel->diameter}},
            .remedies = {{.arguments = {{"keep_components", std::to_string(report.keeping_it)}}}}};
    if (report.removed_outer_wall || report.removed_inner_wall ||
        triangles <= kWorthAWarning * static_cast<double>(before.triangle_count()))
        return std::nullopt;
    return Diagnostic{.code = "pieces-removed",
                      .figures = {{"pieces", pieces}, {"triangles", triangles}},
                      .remedies = {{.arguments = {{"keep_components", ""}}}}};
}

std::vector<Diagnostic> warnings_of(const RepairReport& report, const Surface& before,
                                    bool given_radius) {
    std::vector<Diagnostic> warnings;
    if (report.removed_outer_wall)
        warnings.push_back(
            {.code = "outer-wall-removed", .remedies = {{.arguments = {{"wall", kOuter}}}}});
    if (auto removal = removal_warning(report, before)) warnings.push_back(std::move(*removal));
    if (!given_radius) add_closed_ends(report.closed_ends, warnings);
    if (report.turned_inside_out) warnings.push_back({.code = "orientation-reversed"});
    return warnings;
}

void add_to_headline(ordered_json& report, const std::string& text) {
    std::string headline = report["headline"];
    if (!headline.empty()) headline += ", ";
    report["headline"] = headline + text;
}

void add_caps(ordered_json& report, std::size_t caps) {
    report["flat_caps"] = caps;
    if (caps > 0) add_to_headline(report, counted(caps, "flat cap") + " found");
}

void add_bodies(ordered_json& report, const SettledBodies& bodies) {
    if (bodies.united > 0) {
        report["united_bodies"] = bodies.united;
        report["changed"] = true;
        add_to_headline(report, counted(bodies.united, "body", "bodies") + " united with others");
    }
    if (bodies.no_vessels > 0) {
        report["bodies_left_out"] = bodies.no_vessels;
        report["changed"] = true;
        add_to_headline(report, counted(bodies.no_vessels, "body", "bodies") + " left out");
    }
}

/// Caps are found on surfaces of files only: an image's surface has its own where the image ends.
Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    RepairParameters parameters;
    parameters.close_holes_up_to = arguments.optional_real("close_holes_up_to");
    parameters.keep_components = static_cast<std::size_t>(arguments.integer("keep_components"));
    parameters.outer_wall = arguments.text("wall") == kOuter;
    parameters.remove_self_intersections = arguments.flag("self_intersections");
    parameters.smallest_feature = arguments.real("smallest_feature");
    const SettledBodies bodies =
        settled_bodies(scene, arguments.text("bodies"), progress.part(0.0, 0.1));
    Repaired repaired = repair(bodies.surface, parameters, progress.part(0.1, 0.6));
    if (arguments.text("wall") == kAskWall && !scene.image) ask_about_wall(repaired.report);
    Outcome outcome;
    outcome.resolved = arguments;
    ordered_json report = report_json(repaired.report);
    add_bodies(report, bodies);
    outcome.warnings = bodies.warnings;
    for (Diagnostic& warning :
         warnings_of(repaired.report, bodies.surface, parameters.close_holes_up_to.has_value()))
        outcome.warnings.push_back(std::move(warning));
    if (arguments.flag("caps")) {
        repaired.surface = without_stray_labels(repaired.surface);
        const std::size_t before = repaired.surface.patches.size();
        if (!scene.image)
            repaired.surface = label_flat_caps(repaired.surface, progress.part(0.6, 0.7));
        repaired.surface = label_flat_faces(repaired.surface, progress.part(0.7, 1.0));
        add_caps(report, repaired.surface.patches.size() - before);
    }
    if (!scene.image)  // of an image, extract-surface has named them
        for (Diagnostic& handle : handle_warnings(repaired.surface, progress))
            outcome.warnings.push_back(std::move(handle));
    outcome.report = std::make_shared<ordered_json>(std::move(report));
    outcome.scene = with_surface(scene, std::move(repaired.surface));
    return outcome;
}

}  // namespace

Operation repair_operation() {
    using enum ParameterType;
    return {
        .name = "repair",
        .usual_step = Step::Source,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation, Step::Remeshing},
        .summary = "weld, orient and clean the surface, remove self-intersections and stray holes",
        .parameters =
            {{.name = "close_holes_up_to",
              .type = Real,
              .unit = "mm",
              .help = "close holes up to this radius; default: close holes that are not "
                      "vessel ends, because they are much narrower than the lumen behind them, or "
                      "slits",
              .minimum = 0.0},
             {.name = "keep_components",
              .type = Integer,
              .unit = "-",
              .default_value = std::int64_t{1},
              .help = "number of unconnected pieces to keep, in descending order of area; 1 keeps "
                      "one side of a wall that has two, see wall",
              .minimum = 1},
             bodies_parameter(),
             {.name = "wall",
              .type = Choice,
              .default_value = kLumen,
              .help = "of a wall with two sides, a surface within another one, keep; lumen: the "
                      "inner side; outer: the outer side; ask: it is asked about if the surface "
                      "is of a file",
              .choices = {kLumen, kOuter, kAskWall}},
             {.name = "self_intersections",
              .type = Flag,
              .default_value = true,
              .help = "remove self-intersections of the surface",
              .use = Use::Rare},
             {.name = "smallest_feature",
              .type = Real,
              .unit = "-",
              .default_value = 1e-3,
              .help =
                  "remove edges and triangle heights below this fraction of the mean edge length",
              .minimum = 0.0,
              .maximum = 0.1,
              .use = Use::Rare},
             {.name = "caps",
              .type = Flag,
              .default_value = true,
              .help = "of a surface from a file, find the flat caps that close its vessels: "
                      "they can then be kept as openings"}},
        .run = &run,
        .isolated = true,
        .thesis = "3.2",
        .recipe = {.proves_source = true},
        .example = {.scene = ExampleScene::Holes, .changed = {{"smallest_feature", 0.002}}}};
}

}  // namespace vesselbench
