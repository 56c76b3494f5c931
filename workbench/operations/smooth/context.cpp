#include "workbench/operations/smooth/context.h"

#include <algorithm>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/freed_memory.h"
#include "geometry/kernel/statistics.h"
#include "smoothing/context/cap_rounding.h"
#include "workbench/operations/shared/context_weights.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

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
        throw DiagnosedUsage({.code = "voxel-size-unknown",
                              .operation = "smooth",
                              .words = {{"constraint", cell}},
                              .remedies = {{.arguments = {{"cell", ""}}}}});
    arguments.set("cell", constraint.size);
    return constraint;
}

/// The caps that the arguments ask for.
std::vector<Cap> caps_of(ContextFinder& finder, const Arguments& arguments) {
    if (arguments.text("caps") == "smooth") return {};
    std::vector<Cap> caps = finder.caps();
    if (!arguments.flag("find_caps"))
        std::erase_if(caps, [](const Cap& c) { return !c.from_patch; });
    return caps;
}

std::vector<Parameter> constraint_parameters() {
    using enum ParameterType;
    return {
        {.name = "constraint",
         .type = Choice,
         .default_value = std::string("none"),
         .help = "voxel, diamond: no vertex leaves the voxel, or the octahedron in it, centred on "
                 "its start position",
         .choices = {"none", "voxel", "diamond"},
         .use = Use::Rare},
        {.name = "cell",
         .type = Point,
         .unit = "mm",
         .help = "voxel size of constraint along the image's axes; default: the image's own",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"constraint", {"voxel", "diamond"}},
         .use = Use::Rare}};
}

}  // namespace

std::vector<Parameter> context_parameter_table() {
    using enum ParameterType;
    const Condition when_staircase{"staircase", {"true"}};
    std::vector<Parameter> table = constraint_parameters();
    const WeighedAction action{
        .doing = "smoothing",
        .staircase_help =
            "smooth only the staircases of the image's slices, fading out around them",
        .kept = "do not move",
        .painted_one = "are smoothed in full"};
    const auto add = [&](const std::vector<Parameter>& more) {
        table.insert(table.end(), more.begin(), more.end());
    };
    add(staircase_parameter_table(action));
    add({{.name = "beta_min",
          .unit = "-",
          .help = "fraction of the smoothing applied outside staircases: 0 leaves the rest "
                  "unchanged, 1 smooths it in full like staircases; default: the preset's",
          .minimum = 0.0,
          .maximum = 1.0,
          .only_with = when_staircase},
         {.name = "weight",
          .type = Choice,
          .default_value = std::string("tau-max"),
          .help = "where the smoothing has faded out: tau_max away from staircases, or (thesis, "
                  "Eq. 5.5 as printed) at the farthest vertex within tau_max",
          .choices = {"tau-max", "thesis"},
          .only_with = when_staircase,
          .use = Use::Rare}});
    add(distance_parameter_table(action));
    Parameter& distance =
        *std::ranges::find_if(table, [](const Parameter& p) { return p.name == "distance"; });
    distance.default_value.reset();
    distance.help += "; default: none, for planning linear where neighbours are loaded";
    add({{.name = "caps",
          .type = Choice,
          .default_value = std::string("keep"),
          .help = "keep: vertices of caps and their rims are unchanged, bit for bit; smooth: caps "
                  "are treated as wall; round: caps become domes",
          .choices = {"keep", "smooth", "round"}},
         {.name = "find_caps",
          .type = Flag,
          .default_value = true,
          .help = "also treat flat ends that are not openings as caps, including the first and "
                  "last slice of a mask; false: openings only",
          .only_with = Condition{"caps", {"keep", "round"}},
          .use = Use::Rare}});
    return table;
}

Arguments arguments_in(const std::vector<Parameter>& table, const Arguments& arguments) {
    Arguments own;
    for (const Parameter& parameter : table)
        if (const auto at = arguments.values().find(parameter.name); at != arguments.values().end())
            own.set(parameter.name, at->second);
    return own;
}

Arguments context_arguments(const Arguments& arguments) {
    static const std::vector<Parameter> table = context_parameter_table();
    return arguments_in(table, arguments);
}

void decide_context(const Scene& scene, ContextFinder& finder, Arguments& arguments) {
    static_cast<void>(constraint_part(scene, arguments));
    decide_weights(scene, "smooth", finder, arguments);
}

SmoothingContext smoothing_context(const Scene& scene, ContextFinder& finder,
                                   Arguments& arguments) {
    const Surface& surface = surface_of(scene);
    check_stack_axis(arguments, "smooth");
    SmoothingContext context;
    context.constraint = constraint_part(scene, arguments);
    static_cast<void>(surface.topology->rings());  // before their scratch memory is freed
    release_freed_memory();
    const std::vector<Cap> caps = caps_of(finder, arguments);
    std::vector<std::uint8_t> on_caps = cap_vertices(caps, surface.vertex_count());
    const bool round = context.caps_rounded = arguments.text("caps") == "round";
    context.thesis_scaling = arguments.text("weight") == "thesis";
    context.start =
        round ? std::make_shared<const Positions>(rounded_caps(surface, caps)) : surface.positions;
    context.fixed = round ? std::vector<std::uint8_t>() : on_caps;
    const auto on_cap = static_cast<std::size_t>(std::ranges::count(on_caps, 1));
    ContextWeights found = context_weights(scene,
                                           {.operation = "smooth",
                                            .beta_min = arguments.real("beta_min"),
                                            .thesis_scaling = context.thesis_scaling,
                                            .caps = on_caps},
                                           finder, arguments);
    context.weights = std::move(found.weights);
    context.stack_axes = std::move(found.stack_axes);
    context.figures = {caps.size(), round ? 0 : on_cap, std::move(found.figures)};
    if (round && !context.weights.empty()) {
        for (std::size_t v = 0; v < on_caps.size(); ++v)
            if (on_caps[v] != 0) context.weights[v] = context.cap_weight();
        context.figures.weights.mean_weight = mean(context.weights);
    }
    context.caps = std::move(on_caps);
    return context;
}

}  // namespace vesselbench
