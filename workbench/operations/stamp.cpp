#include "meshing/stamp/stamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/stamp/tool.h"
#include "workbench/operations/stamp/topology_json.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json report_json(const StampReport& figures, bool at_contact) {
    const bool removed = figures.volume_change < 0.0;
    Json report = {{"at_contact", at_contact},
                   {removed ? "removed_mm3" : "added_mm3", std::abs(figures.volume_change)},
                   {"triangles_replaced", figures.replaced},
                   {"triangles_new", figures.replacement},
                   {"edge_mm", figures.edge},
                   {"influence_mm", figures.influence}};
    add_topology(report, figures);
    return report;
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const SurfaceDistance places = distance_to(surface);
    Outcome outcome;
    outcome.resolved = arguments;
    // A box without a direction is put where two vessels touch.
    const bool at_contact = arguments.text("shape") == "box" && !arguments.has("direction");
    resolve_tool(surface, places, outcome.resolved);
    const bool subtracts = arguments.text("mode") == "subtract";
    Stamped stamped = stamp(surface, places, tool_from(outcome.resolved),
                            {.mode = subtracts ? StampMode::Subtract : StampMode::Add,
                             .blend = outcome.resolved.real("blend")},
                            progress);
    outcome.report = std::make_shared<Json>(report_json(stamped.report, at_contact));
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

constexpr int kAround = 24;            ///< rays around the waist of a contact
constexpr double kBeside = 1.4;        ///< where they start [half waists]
constexpr double kDeep = 2.5;          ///< how far they look [half waists]
constexpr double kFacing = 0.5;        ///< cosine between a wall that faces the cut and its normal
constexpr double kLeastFacing = 0.35;  ///< share of the rays that meet such wall, on either side
constexpr double kGrown = 1.3;         ///< the box's length, of the waist's (tool.cpp) [-]

/// Share of the rays beside the waist that meet wall which faces them [-].
double facing_share(const Surface& surface, const SurfaceDistance& places, const Arguments& box,
                    const Vec3& side) {
    const Vec3 along = box.point("along").normalized(), across = side.cross(along);
    const double half_length = 0.5 * box.real("length") / kGrown,
                 half_width = 0.5 * box.real("width") / kGrown;
    int facing = 0;
    for (int i = 0; i < kAround; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kAround;
        const Vec3 start = box.point("centre") + kBeside * (half_length * std::cos(angle) * along +
                                                            half_width * std::sin(angle) * across);
        const auto hit = places.first_hit(start, side, kDeep * std::max(half_length, half_width));
        if (!hit || hit->from_inside) continue;
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[hit->triangle]);
        if (normal.dot(side) < -kFacing * normal.norm()) ++facing;
    }
    return static_cast<double>(facing) / kAround;
}

/// A contact is where it was looked for, and walls of two vessels face each other around it. Around
/// a cut through a vessel, none do.
std::optional<Diagnostic> doubt_about(const Surface& surface, const Arguments& box) {
    const Vec3 centre = box.point("centre"), direction = box.point("direction").normalized();
    const std::vector<Remedy> remedies = {{.arguments = {{"at", ""}}},
                                          {.arguments = {{"direction", ""}}}};
    const double away = box.has("at") ? (box.point("at") - centre).norm() : 0.0;
    if (away > 0.5 * box.real("length"))
        return Diagnostic{.code = "contact-elsewhere",
                          .place = centre,
                          .figures = {{"distance_mm", away}},
                          .remedies = remedies};
    const SurfaceDistance places = distance_to(surface);
    const double facing = std::min(facing_share(surface, places, box, direction),
                                   facing_share(surface, places, box, -direction));
    if (facing >= kLeastFacing) return std::nullopt;
    return Diagnostic{.code = "contact-cuts-vessel",
                      .place = centre,
                      .figures = {{"facing_percent", 100.0 * facing}},
                      .remedies = remedies};
}

/// Within reach of the tool, what is subtracted is lost, or what is added is gained.
StatedChange stamped(const Scene& before, const Outcome& outcome) {
    const ToolBody tool = tool_from(outcome.resolved);
    const double around = kRoom * outcome.report->at("influence_mm").get<double>();
    StatedChange stated{.zones = {{{tool.centre, tool.reach + around}}},
                        .parts = kAnyGain,
                        .handles = kAnyGrowth,
                        .keeps_walls_apart = true};
    const double faired = kFaired * std::abs(volume(surface_of(before)));
    const bool subtracts = outcome.resolved.text("mode") == "subtract";
    (subtracts ? stated.volume_gained : stated.volume_lost) = faired;
    if (outcome.report->value("at_contact", false) && subtracts)
        stated.doubt = doubt_about(surface_of(before), outcome.resolved);
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
