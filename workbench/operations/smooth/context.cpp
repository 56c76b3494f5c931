#include "workbench/operations/smooth/context.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/freed_memory.h"
#include "smoothing/context/cap_rounding.h"
#include "workbench/operations/context_weights.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::optional<PositionConstraint> constraint_part(const Scene& scene, Arguments& arguments) {
    const std::string& cell = arguments.text("constraint");
    if (cell == "none") return std::nullopt;
    PositionConstraint constraint;
    constraint.cell =
        cell == "voxel" ? PositionConstraint::Cell::Voxel : PositionConstraint::Cell::Diamond;
    if (scene.sampling) {
        constraint.axes = scene.sampling->axes;
        constraint.size = scene.sampling->spacing;
    }
    if (arguments.has("cell")) constraint.size = arguments.point("cell");
    if (!scene.sampling && !arguments.has("cell"))
        throw UsageError("smooth: constraint=" + cell +
                         " needs the voxels' size: give cell=x,y,z in mm, each above 0");
    arguments.set("cell", constraint.size);
    return constraint;
}

/// Caps as far as the arguments ask for them.
std::vector<Cap> caps_of(ContextFinder& finder, const Arguments& arguments) {
    if (arguments.text("caps") == "smooth") return {};
    std::vector<Cap> caps = finder.caps();
    if (!arguments.flag("find_caps"))
        std::erase_if(caps, [](const Cap& c) { return !c.from_patch; });
    return caps;
}

}  // namespace

std::vector<Parameter> context_parameter_table() {
    using enum ParameterType;
    const Condition when_staircase{"staircase", {"true"}};
    std::vector<Parameter> table = {
        {.name = "constraint",
         .type = Choice,
         .default_value = std::string("none"),
         .help = "voxel, diamond: no vertex leaves the voxel, or the octahedron in it, around "
                 "its place at the start",
         .choices = {"none", "voxel", "diamond"}},
        {.name = "cell",
         .type = Point,
         .unit = "mm",
         .help = "size of the voxels of constraint along the image's axes; the image's own "
                 "when left out",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"constraint", {"voxel", "diamond"}}}};
    const WeighedAction action{
        .doing = "smoothing",
        .staircase_help = "smooth staircases of the image's slices only, and fade out around them",
        .kept = "do not move",
        .painted_one = "smooths it"};
    const auto add = [&](const std::vector<Parameter>& more) {
        table.insert(table.end(), more.begin(), more.end());
    };
    add(staircase_parameter_table(action));
    add({{.name = "beta_min",
          .unit = "-",
          .help = "how much of the smoothing all that is no staircase gets: 0 stays where it is, "
                  "1 is smoothed as staircases are; the preset's when left out",
          .minimum = 0.0,
          .maximum = 1.0,
          .only_with = when_staircase},
         {.name = "weight",
          .type = Choice,
          .default_value = std::string("tau-max"),
          .help = "where the smoothing has faded out: tau_max away from staircases, or (thesis, "
                  "as it prints Eq. 5.5) at the farthest vertex within tau_max",
          .choices = {"tau-max", "thesis"},
          .only_with = when_staircase}});
    add(distance_parameter_table(action));
    add({{.name = "caps",
          .type = Choice,
          .default_value = std::string("keep"),
          .help = "keep: vertices of caps and their rims stay bit for bit; smooth: caps are "
                  "wall; round: caps become domes",
          .choices = {"keep", "smooth", "round"}},
         {.name = "find_caps",
          .type = Flag,
          .default_value = true,
          .help = "look for flat ends that are no openings yet, too: also the first and last "
                  "slice of a mask; false: openings only",
          .only_with = Condition{"caps", {"keep", "round"}}}});
    return table;
}

SmoothingContext smoothing_context(const Scene& scene, ContextFinder& finder, Arguments& arguments,
                                   Json& report) {
    const Surface& surface = surface_of(scene);
    check_stack_axis(arguments, "smooth");
    SmoothingContext context;
    context.constraint = constraint_part(scene, arguments);
    static_cast<void>(surface.topology->rings());  // what making them has taken is not needed again
    release_freed_memory();
    const std::vector<Cap> caps = caps_of(finder, arguments);
    std::vector<std::uint8_t> on_caps = cap_vertices(caps, surface.vertex_count());
    const bool round = arguments.text("caps") == "round";
    context.start =
        round ? std::make_shared<const Positions>(rounded_caps(surface, caps)) : surface.positions;
    context.fixed = round ? std::vector<std::uint8_t>() : on_caps;
    report["caps"] = caps.size();
    report["cap_vertices_kept"] = round ? 0 : std::ranges::count(on_caps, 1);
    context.weights = context_weights(scene,
                                      {.operation = "smooth",
                                       .beta_min = arguments.real("beta_min"),
                                       .thesis_scaling = arguments.text("weight") == "thesis",
                                       .caps = on_caps},
                                      finder, arguments, report);
    if (round && !context.weights.empty())
        for (std::size_t v = 0; v < on_caps.size(); ++v)
            if (on_caps[v] != 0) context.weights[v] = 1.0;
    context.caps = std::move(on_caps);
    return context;
}

}  // namespace vesselbench
