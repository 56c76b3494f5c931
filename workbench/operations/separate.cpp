#include "meshing/stamp/separate.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/handles.h"
#include "geometry/kernel/measure.h"
#include "workbench/case/point_json.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/stamp/topology_json.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kEdges = 1.5;  ///< default gap without an image [mean edges]

/// Where the surface has its narrowest handle.
Vec3 place_of_handle(const Surface& surface, const Progress& progress) {
    const std::optional<int> genus = connectivity(*surface.topology).genus;
    if (!genus)
        throw DiagnosedFailure({.code = "surface-not-manifold",
                                .operation = "separate",
                                .remedies = {{.operation = "repair", .before = true}}});
    std::vector<SurfaceHandle> handles;
    if (*genus > 0) handles = handles_of(surface, progress.silent());
    if (handles.empty())
        throw DiagnosedFailure({.code = "no-contact-found",
                                .operation = "separate",
                                .remedies = {{.arguments = {{"at", ""}}}}});
    return handles.front().centre;
}

double default_gap(const Scene& scene) {
    return scene.sampling ? scene.sampling->spacing.maxCoeff()
                          : kEdges * mean_edge_length(surface_of(scene));
}

/// Sets the place and the gap that are left out.
void resolve(const Scene& scene, const Progress& progress, Arguments& arguments) {
    if (arguments.has("side_a") != arguments.has("side_b"))
        throw UsageError("separate: give both side_a and side_b, or neither");
    if (!arguments.has("at")) arguments.set("at", place_of_handle(surface_of(scene), progress));
    if (!arguments.has("gap")) arguments.set("gap", default_gap(scene));
}

SeparateParameters parameters_from(const Arguments& resolved) {
    SeparateParameters parameters{.at = resolved.point("at"), .gap = resolved.real("gap")};
    if (resolved.has("side_a"))
        parameters.vessel = {resolved.point("side_a"), resolved.point("side_b")};
    return parameters;
}

void set_vessel(Arguments& arguments, const std::array<Vec3, 2>& vessel) {
    if (arguments.has("side_a")) return;
    arguments.set("side_a", vessel[0]);
    arguments.set("side_b", vessel[1]);
}

Json report_json(const SeparateReport& figures) {
    Json report = {{"contact_mm", point_json(figures.centre)},
                   {"contact_width_mm", figures.width},
                   {"contact_length_mm", figures.length},
                   {"waist", figures.waist},
                   {"gap_mm", figures.gap},
                   {"largest_mm", figures.farthest},
                   {"lost_height_mm", figures.lost},
                   {"lost_height_at_mm", point_json(figures.lost_at)},
                   {"influence_mm", figures.influence},
                   {"radius_a_mm", figures.radii[0]},
                   {"radius_b_mm", figures.radii[1]},
                   {"triangles_replaced", figures.replaced},
                   {"triangles_new", figures.replacement}};
    add_topology(report, figures);
    return report;
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    resolve(scene, progress, outcome.resolved);
    Separated separated =
        separate(surface, distance_to(surface), parameters_from(outcome.resolved), progress);
    set_vessel(outcome.resolved, separated.report.vessel);
    outcome.report = std::make_shared<Json>(report_json(separated.report));
    outcome.scene = with_surface(scene, std::move(separated.surface));
    return outcome;
}

Arguments decided(const Scene& scene, const CheckedArguments& arguments, const Progress& progress) {
    const Surface& surface = surface_of(scene);
    Arguments found = arguments;
    resolve(scene, progress, found);
    if (!found.has("side_a"))
        set_vessel(found,
                   vessel_through(surface, distance_to(surface), parameters_from(found), progress));
    return found;
}

/// A contact of two vessels is no wider than the thinner one.
constexpr double kWidest = 1.05;  ///< waist [-]
/// The fillets of a contact that wide lie 0.4 radii over its vessels.
constexpr double kHighest = 0.6;  ///< height of what is lost [radii of the thinner vessel]
constexpr double kLost = 1.0;     ///< distance of what is lost from the new walls [the same]

std::vector<Remedy> another_place() {
    return {{.arguments = {{"at", ""}}}, {.operation = "stamp"}};
}

/// \param thinner radius of the thinner vessel [mm]
std::optional<Diagnostic> doubt_about(const Json& figures, double thinner) {
    const double width = figures.at("contact_width_mm").get<double>(),
                 height = figures.at("lost_height_mm").get<double>();
    if (figures.at("waist").get<double>() > kWidest)
        return Diagnostic{.code = "contact-too-wide",
                          .place = point_from(figures.at("contact_mm")),
                          .figures = {{"width_mm", width}, {"diameter_mm", 2.0 * thinner}},
                          .remedies = another_place()};
    if (height > kHighest * thinner)
        return Diagnostic{.code = "contact-not-alone",
                          .place = point_from(figures.at("lost_height_at_mm")),
                          .figures = {{"height_mm", height}},
                          .remedies = another_place()};
    return std::nullopt;
}

/// Two vessels become apart, or a loop is opened, in a ball; neither loses what branches off.
StatedChange parted_vessels(const Scene&, const Outcome& outcome) {
    const Json& figures = *outcome.report;
    const double thinner =
        std::min(figures.at("radius_a_mm").get<double>(), figures.at("radius_b_mm").get<double>());
    const ChangeZone zone{point_from(figures.at("contact_mm")),
                          figures.at("influence_mm").get<double>() * (1.0 + 1e-9)};
    return {.zones = {{zone}},
            .parts = {0, 1},
            .handles = {-1, 0},
            .wall_lost = kLost * thinner + figures.at("gap_mm").get<double>(),
            .keeps_walls_apart = true,
            .remedies = another_place(),
            .doubt = doubt_about(figures, thinner)};
}

}  // namespace

Operation separate_operation() {
    using enum ParameterType;
    return {
        .name = "separate",
        .usual_step = Step::LocalRepair,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation},
        .summary = "make two vessels of two that are blended where they touch",
        .parameters =
            {{.name = "at",
              .type = Point,
              .unit = "mm",
              .help = "a place at the contact, on its wall or inside; default: the narrowest "
                      "handle of the surface",
              .meaning = Meaning::Place},
             {.name = "gap",
              .unit = "mm",
              .help = "least distance between both walls afterwards; default: the longest edge of "
                      "the image's voxels, or one and a half edges of the triangles",
              .minimum = 0.0,
              .above_minimum = true},
             {.name = "side_a",
              .type = Point,
              .unit = "mm",
              .help = "a place of one of the vessels, on one side of the contact: says, together "
                      "with side_b, which parts belong together; default: those whose walls "
                      "continue each other",
              .meaning = Meaning::Place,
              .use = Use::Rare},
             {.name = "side_b",
              .type = Point,
              .unit = "mm",
              .help = "a place of the same vessel on the contact's other side",
              .meaning = Meaning::Place,
              .use = Use::Rare}},
        .run = &run,
        .decided = &decided,
        .may_change = &parted_vessels,
        .thesis = "4.2.5",
        .example = {.scene = ExampleScene::Contact, .placed = {"at"}, .changed = {{"gap", 0.25}}}};
}

}  // namespace vesselbench
