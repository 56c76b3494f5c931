#include "geometry/vessel/openings/remove_branch.h"

#include <cmath>
#include <memory>

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/branch_part.h"
#include "workbench/case/point_json.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

Outcome remove(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const NamedBranch branch =
        branch_at_tip(surface, arguments.point("tip"), progress.part(0.0, 0.8));
    progress.report(0.8, "removing the branch");
    const BranchRemoval removal =
        remove_branch(surface, *branch.graph, branch.tip,
                      {.margin = arguments.real("margin"),
                       .continuity = static_cast<int>(arguments.integer("continuity"))});
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.report =
        std::make_shared<ordered_json>(ordered_json{{"mouth_mm", point_json(removal.mouth)},
                                                    {"removed_area_mm2", removal.removed_area},
                                                    {"new_triangles", removal.new_triangles},
                                                    {"follows_parent", removal.follows_parent}});
    outcome.scene = with_surface(scene, removal.surface);
    return outcome;
}

constexpr double kBulge = 0.05;  ///< of the volume, that the new wall may add [-]

/// The branch goes with its loops and open ends, and nothing is added but its parent's wall.
StatedChange removed_branch(const Scene& before, const Outcome&) {
    return {.handles = kAnyLoss,
            .rims = kAnyLoss,
            .volume_gained = kBulge * std::abs(volume(surface_of(before))),
            .keeps_walls_apart = true,
            .remedies = {{.arguments = {{"margin", ""}}}}};
}

}  // namespace

Operation remove_branch_operation() {
    using enum ParameterType;
    return {
        .name = "remove-branch",
        .usual_step = Step::Branches,
        .allowed = {Step::Branches, Step::LocalRepair, Step::Openings},
        .summary = "cut off a branch or an aneurysm at its root and rebuild the parent's wall",
        .parameters = {{.name = "tip",
                        .type = Point,
                        .unit = "mm",
                        .help = "a point near the tip of the branch, or in the aneurysm's dome",
                        .required = true,
                        .meaning = Meaning::Branch},
                       {.name = "margin",
                        .unit = "-",
                        .default_value = 0.4,
                        .help = "width of the parent's wall to rebuild around the branch's foot, "
                                "in radii of the branch; more where a wide fillet remains",
                        .minimum = 0.0,
                        .maximum = 3.0},
                       {.name = "continuity",
                        .type = Integer,
                        .unit = "-",
                        .default_value = std::int64_t{1},
                        .help =
                            "how the new wall joins the old one: 1 without a crease, 2 with the "
                            "same curvature",
                        .minimum = 1,
                        .maximum = 2}},
        .run = &remove,
        .may_change = &removed_branch,
        .thesis = "4.2.2",
        .example = {.scene = ExampleScene::Branches, .changed = {{"margin", 0.5}}}};
}

}  // namespace vesselbench
