#include "geometry/vessel/posing/part_branches.h"

#include <nlohmann/json.hpp>

#include "geometry/vessel/centerlines/centerlines.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json gaps_json(const std::vector<BranchGap>& gaps) {
    Json all = Json::array();
    for (const BranchGap& gap : gaps)
        all.push_back({{"from_mm", point_json(gap.from)},
                       {"to_mm", point_json(gap.to)},
                       {"before_mm", gap.before},
                       {"after_mm", gap.after}});
    return all;
}

Json shifts_json(const std::vector<BranchShift>& shifts) {
    Json all = Json::array();
    for (const BranchShift& shift : shifts)
        all.push_back({{"branch_end_mm", point_json(shift.end)},
                       {"largest_mm", shift.largest},
                       {"place_mm", point_json(shift.place)}});
    return all;
}

Outcome part(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const auto graph = centerlines_of(surface, {}, progress.part(0.0, 0.4));
    const double gap = arguments.real("gap");
    const PartedBranches parted = part_branches(surface, *graph, gap, progress.part(0.4, 1.0));
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.report = std::make_shared<Json>(Json{{"gaps", gaps_json(parted.gaps)},
                                                 {"shifts", shifts_json(parted.shifts)},
                                                 {"rounds", parted.rounds}});
    outcome.scene = with_surface(scene, parted.surface);
    if (parted.gaps.empty())
        outcome.warnings.push_back({.code = "branches-apart", .figures = {{"gap_mm", gap}}});
    else
        outcome.warnings.push_back({.code = "branches-parted",
                                    .place = parted.gaps.front().from,
                                    .figures = {{"gap_mm", parted.gaps.front().after},
                                                {"before_mm", parted.gaps.front().before},
                                                {"shift_mm", parted.shifts.front().largest}}});
    return outcome;
}

}  // namespace

Operation part_branches_operation() {
    return {
        .name = "part-branches",
        .usual_step = Step::Deformation,
        .allowed = {Step::Deformation},
        .summary = "push branches apart until every gap between them can be printed",
        .parameters = {{.name = "gap",
                        .unit = "mm",
                        .default_value = 1.0,
                        .help = "smallest distance between the walls of two branches that face "
                                "each other",
                        .minimum = 0.0,
                        .above_minimum = true}},
        .run = &part,
        .may_change = &moved_vertices,
        .thesis = "4.2.10",
        .example = {
            .scene = ExampleScene::Branches, .given = {{"gap", 0.05}}, .changed = {{"gap", 0.07}}}};
}

}  // namespace vesselbench
