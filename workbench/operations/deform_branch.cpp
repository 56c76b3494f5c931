#include "geometry/vessel/posing/deform_branch.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

BranchDeformation deformation_of(const Arguments& arguments) {
    BranchDeformation deformation{.at = arguments.point("at"),
                                  .straighten = arguments.real("straighten")};
    if (arguments.has("move")) deformation.move = arguments.point("move");
    if (arguments.has("reach")) deformation.reach = arguments.real("reach");
    if (deformation.move == Vec3::Zero() && deformation.straighten == 0.0)
        throw DiagnosedUsage(
            {.code = "nothing-to-deform",
             .operation = "deform-branch",
             .remedies = {{.arguments = {{"move", ""}}}, {.arguments = {{"straighten", ""}}}}});
    return deformation;
}

Json report_of(const DeformedBranch& deformed) {
    return {{"from_mm", point_json(deformed.from)},
            {"to_mm", point_json(deformed.to)},
            {"largest_shift_mm", deformed.largest_shift},
            {"moved_vertices", deformed.moved_vertices},
            {"sharpest_bend_radii", deformed.sharpest_radii}};
}

Outcome deform(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const BranchDeformation deformation = deformation_of(arguments);
    const auto graph = centerlines_of(surface, {}, progress.part(0.0, 0.6));
    const DeformedBranch deformed =
        deform_branch(surface, *graph, deformation, progress.part(0.6, 1.0));
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.resolved.set("reach", deformed.reach);
    outcome.report = std::make_shared<Json>(report_of(deformed));
    outcome.scene = with_surface(scene, deformed.surface);
    return outcome;
}

constexpr double kMostMove = 1000.0;  ///< in each direction [mm]: no vessel is longer

std::vector<Parameter> deform_parameters() {
    using enum ParameterType;
    return {{.name = "at",
             .type = Point,
             .unit = "mm",
             .help = "a place on the branch, on its wall or inside",
             .required = true,
             .meaning = Meaning::Place},
            {.name = "move",
             .type = Point,
             .unit = "mm",
             .help = "by which the place moves: across the vessel as given, along it as far as the "
                     "vessel's length permits, which stays",
             .minimum = -kMostMove,
             .maximum = kMostMove},
            {.name = "straighten",
             .unit = "-",
             .default_value = 0.0,
             .help = "share of its bends that the vessel loses within reach; 1 is straight",
             .minimum = 0.0,
             .maximum = 1.0},
            {.name = "reach",
             .unit = "mm",
             .help = "length along the branch, on each side of the place, within which it bends; "
                     "default: 8 radii, or twice the move",
             .minimum = 0.0,
             .above_minimum = true}};
}

}  // namespace

Operation deform_branch_operation() {
    return {.name = "deform-branch",
            .usual_step = Step::Deformation,
            .allowed = {Step::Deformation},
            .summary = "move a place of a branch, or straighten it; sections and length stay",
            .parameters = deform_parameters(),
            .run = &deform,
            .may_change = &moved_vertices,
            .thesis = "4.2.10",
            .example = {.given = {{"straighten", 0.5}}, .changed = {{"straighten", 0.75}}}};
}

}  // namespace vesselbench
