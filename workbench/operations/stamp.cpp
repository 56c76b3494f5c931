#include "meshing/stamp/stamp.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/stamp/tool.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json report_json(const StampReport& figures) {
    const bool removed = figures.volume_change < 0.0;
    return {{removed ? "removed_mm3" : "added_mm3", std::abs(figures.volume_change)},
            {"triangles_replaced", figures.replaced},
            {"triangles_new", figures.replacement},
            {"edge_mm", figures.edge},
            {"influence_mm", figures.influence},
            {"components_before", figures.components_before},
            {"components_after", figures.components_after},
            {"genus_before", figures.genus_before},
            {"genus_after", figures.genus_after}};
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const SurfaceDistance places = distance_to(surface);
    Outcome outcome;
    outcome.resolved = arguments;
    resolve_tool(surface, places, outcome.resolved);
    const bool subtracts = arguments.text("mode") == "subtract";
    Stamped stamped = stamp(surface, places, tool_from(outcome.resolved),
                            {.mode = subtracts ? StampMode::Subtract : StampMode::Add,
                             .blend = outcome.resolved.real("blend")},
                            progress);
    outcome.report = std::make_shared<Json>(report_json(stamped.report));
    outcome.scene = with_surface(scene, std::move(stamped.surface));
    return outcome;
}

Arguments decided_tool(const Scene& scene, const CheckedArguments& arguments, const Progress&) {
    const Surface& surface = surface_of(scene);
    Arguments decided = arguments;
    resolve_tool(surface, distance_to(surface), decided);
    return decided;
}

std::vector<Parameter> stamp_parameters() {
    std::vector<Parameter> table = {{.name = "mode",
                                     .type = ParameterType::Choice,
                                     .default_value = "subtract",
                                     .help = "subtract the tool from the vessel, or add it",
                                     .choices = {"subtract", "add"}}};
    for (Parameter& parameter : tool_parameters()) table.push_back(std::move(parameter));
    table.push_back({.name = "blend",
                     .unit = "mm",
                     .help = "width on each side of the seam over which wall and tool are faired "
                             "into each other; 0 keeps the crease; default: a quarter of the "
                             "thickness or radius",
                     .minimum = 0.0});
    return table;
}

constexpr double kRoom = 4.0;     ///< around a tool, in which triangles change [influences]
constexpr double kFaired = 0.02;  ///< of the volume, by which faired seams go the other way [-]

/// Within reach of the tool, what is subtracted is lost, or what is added is gained.
StatedChange stamped(const Scene& before, const Outcome& outcome) {
    const ToolBody tool = tool_from(outcome.resolved);
    const double around = kRoom * outcome.report->at("influence_mm").get<double>();
    StatedChange stated{.zones = {{{tool.centre, tool.reach + around}}},
                        .parts = kAnyGain,
                        .handles = kAnyGrowth,
                        .keeps_walls_apart = true};
    const double faired = kFaired * std::abs(volume(surface_of(before)));
    (outcome.resolved.text("mode") == "subtract" ? stated.volume_gained : stated.volume_lost) =
        faired;
    return stated;
}

}  // namespace

Operation stamp_operation() {
    return {.name = "stamp",
            .usual_step = Step::LocalRepair,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation},
            .summary =
                "subtract a box, a capsule or a swept polygon from the vessel, or add it; "
                "separates vessels that touch",
            .parameters = stamp_parameters(),
            .run = &run,
            .decided = &decided_tool,
            .may_change = &stamped,
            .thesis = "4.2.5",
            .example = {.placed = {"at"},
                        .given = {{"shape", std::string("capsule")},
                                  {"mode", std::string("add")},
                                  {"radius", 0.5},
                                  {"length", 0.5}},
                        .changed = {{"radius", 0.625}}}};
}

}  // namespace vesselbench
