#include "workbench/operations/smooth/context.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "geometry/kept_memory.h"
#include "smoothing/cap_rounding.h"
#include "smoothing/distance_weights.h"
#include "smoothing/stack_orientation.h"
#include "smoothing/staircase_weights.h"
#include "smoothing/staircases.h"
#include "workbench/near_names.h"
#include "workbench/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Multiplies one more kind of weights in, and reports its mean.
void weigh(std::vector<double>& weights, std::vector<double> by, const char* kind, Json& report) {
    const double sum = std::accumulate(by.begin(), by.end(), 0.0);
    report["mean_weight_" + std::string(kind)] =
        by.empty() ? 0.0 : sum / static_cast<double>(by.size());
    if (weights.empty())
        weights = std::move(by);
    else
        for (std::size_t v = 0; v < by.size(); ++v) weights[v] *= by[v];
}

/// The stack axis that the user gave; also one that is not asked for must make sense.
std::optional<Vec3> given_stack_axis(const Arguments& arguments) {
    const auto axis = arguments.optional_point("stack_axis");
    if (!axis) return std::nullopt;
    const Vec3 direction = axis->stableNormalized();
    if (direction.allFinite() && direction.norm() > 0.5) return direction;
    throw UsageError("smooth: stack_axis = " + to_text(*axis) +
                     " has no direction: give three numbers that are not all 0");
}

/// A flat end has a normal that many faces share, but is no staircase.
Surface without_caps(const Surface& surface) {
    std::vector<std::uint8_t> on_cap(surface.triangle_count(), 0);
    for (const Cap& cap : find_caps(surface))
        for (const TriangleId t : cap.triangles) on_cap[t] = 1;
    std::vector<Triangle> wall;
    for (TriangleId t = 0; t < on_cap.size(); ++t)
        if (on_cap[t] == 0) wall.push_back(surface.triangles()[t]);
    return make_surface(surface.points(), std::move(wall));
}

/// Where the stack axis comes from: the user, the image, or the surface itself.
Vec3 stack_axis(const Scene& scene, Arguments& arguments, Json& report) {
    if (const auto given = given_stack_axis(arguments)) {
        report["stack_axis_from"] = "argument";
        return *given;
    }
    if (scene.sampling && scene.sampling->confidence > 0.0) {
        const Vec3 axis = scene.sampling->axes.col(2);
        report["stack_axis_from"] = "image";
        arguments.set("stack_axis", axis);
        return axis;
    }
    const StackOrientation estimate = estimate_stack_orientation(without_caps(surface_of(scene)));
    report["stack_axis_confidence"] = estimate.confidence;
    if (!estimate.certain)
        throw AlgorithmFailure(
            "the direction of the image stack is uncertain: the surface comes from no image and "
            "shows too few staircases; give stack_axis=x,y,z, or staircase=false");
    report["stack_axis_from"] = "estimate";
    arguments.set("stack_axis", estimate.direction);
    return estimate.direction;
}

std::vector<double> staircase_part(const Scene& scene, const Surface& surface,
                                   const std::vector<std::uint8_t>& caps, Arguments& arguments,
                                   Json& report) {
    const Vec3 axis = stack_axis(scene, arguments, report);
    const StaircaseParameters parameters{.tau_theta = arguments.real("tau_theta"),
                                         .tau_max = arguments.real("tau_max"),
                                         .beta_min = arguments.real("beta_min"),
                                         .scaling = arguments.text("weight") == "thesis"
                                                        ? StaircaseScaling::Thesis
                                                        : StaircaseScaling::TauMax,
                                         .caps = caps};
    const auto change = orientation_change(*surface.topology, surface.points(), axis);
    auto weights = staircase_weights(*surface.topology, surface.points(), change, parameters);
    report["stack_axis"] = point_json(axis);
    std::size_t count = 0;
    for (std::size_t v = 0; v < change.size(); ++v)
        count += change[v] > parameters.tau_theta && caps[v] == 0 ? 1 : 0;
    report["staircase_vertices"] = count;
    return weights;
}

/// The names of the neighbours that count: those given, or all that are loaded.
std::vector<std::string> neighbour_names(const Scene& scene, const Arguments& arguments) {
    std::vector<std::string> names;
    if (const auto given = arguments.optional_text("neighbours")) {
        std::istringstream list(*given);
        for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    } else {
        for (const auto& [name, surface] : scene.neighbours) names.push_back(name);
    }
    if (names.empty())
        throw InvalidInput(
            "smooth: distance awareness needs a neighbour, and there is none: use load-neighbour");
    return names;
}

std::vector<Surface> neighbours_of(const Scene& scene, const std::vector<std::string>& names) {
    std::vector<Surface> neighbours;
    for (const std::string& name : names) {
        const auto found = scene.neighbours.find(name);
        if (found == scene.neighbours.end())
            throw InvalidInput("smooth: there is no neighbour '" + name +
                               "': use load-neighbour, or name others by neighbours=");
        const Surface& surface = found->second;
        if (surface.empty())
            throw InvalidInput("smooth: the neighbour '" + name +
                               "' has no triangles: load it again, or use distance=none");
        neighbours.push_back(surface);
    }
    return neighbours;
}

std::vector<double> distance_part(const Scene& scene, const Surface& surface, Arguments& arguments,
                                  Json& report) {
    const std::string& name = arguments.text("distance");
    const std::vector<std::string> names = neighbour_names(scene, arguments);
    arguments.set("neighbours", joined(names, ","));  // one loaded later changes nothing here
    const DistanceParameters parameters{.scaling = name == "margin" ? DistanceScaling::Margin
                                                   : name == "exponential"
                                                       ? DistanceScaling::Exponential
                                                       : DistanceScaling::Linear,
                                        .margin = arguments.real("margin"),
                                        .omega = arguments.real("omega")};
    const auto distances = neighbour_distances(surface.points(), neighbours_of(scene, names));
    report["smallest_neighbour_distance_mm"] = std::ranges::min(distances);
    report["largest_neighbour_distance_mm"] = std::ranges::max(distances);
    return distance_weights(distances, parameters);
}

std::vector<double> painted_part(const Surface& surface, const std::string& name) {
    const auto attribute = surface.attributes.find(name);
    if (attribute == surface.attributes.end())
        throw InvalidInput("smooth: the surface has no attribute '" + name + "' to weigh with");
    for (const double weight : *attribute->second)
        if (!(weight >= 0.0 && weight <= 1.0))
            throw InvalidInput("smooth: the attribute '" + name +
                               "' holds values outside of [0, 1]");
    return *attribute->second;
}

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
std::vector<Cap> caps_of(const Surface& surface, const Arguments& arguments) {
    if (arguments.text("caps") == "smooth") return {};
    std::vector<Cap> caps = find_caps(surface);
    if (!arguments.flag("find_caps"))
        std::erase_if(caps, [](const Cap& c) { return !c.from_patch; });
    return caps;
}

}  // namespace

double smallest_neighbour_distance(const Scene& scene, const Arguments& arguments,
                                   const Positions& positions) {
    return std::ranges::min(
        neighbour_distances(positions, neighbours_of(scene, neighbour_names(scene, arguments))));
}

std::vector<Parameter> context_parameter_table() {
    using enum ParameterType;
    const Condition when_staircase{"staircase", {"true"}};
    return {
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
         .only_with = Condition{"constraint", {"voxel", "diamond"}}},
        {.name = "staircase",
         .type = Flag,
         .default_value = false,
         .help = "smooth staircases of the image's slices only, and fade out around them"},
        {.name = "stack_axis",
         .type = Point,
         .help = "direction across the image's slices, in patient coordinates; known from the "
                 "image, or estimated from the surface, when left out",
         .only_with = when_staircase},
        {.name = "tau_theta",
         .unit = "-",
         .default_value = 0.7,
         .help = "how sharply a surface must bend across the slices to be a staircase: 1 is a "
                 "right angle; smaller finds smoother staircases",
         .minimum = 0.0,
         .maximum = 1.0,
         .only_with = when_staircase},
        {.name = "tau_max",
         .unit = "mm",
         .default_value = 3.0,
         .help = "how far around staircases the smoothing fades out; about a slice distance",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = when_staircase},
        {.name = "beta_min",
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
         .only_with = when_staircase},
        {.name = "distance",
         .type = Choice,
         .default_value = std::string("none"),
         .help = "keep what is near the structures of load-neighbour; the nearest vertex gets "
                 "no smoothing, the farthest all of it, and between them it grows evenly "
                 "(linear), from a margin on, or late and fast (exponential)",
         .choices = {"none", "linear", "margin", "exponential"}},
        {.name = "neighbours",
         .type = Text,
         .help = "names of the neighbours that count, a,b,...; all that are loaded by then when "
                 "left out",
         .only_with = Condition{"distance", {"linear", "margin", "exponential"}}},
        {.name = "margin",
         .unit = "mm",
         .default_value = 2.0,
         .help = "vertices that are this near to a neighbour do not move",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"distance", {"margin"}}},
        {.name = "omega",
         .unit = "1/mm",
         .default_value = 0.06,
         .help = "how late the smoothing sets in: near 0 as linear; larger keeps more of what "
                 "is near",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"distance", {"exponential"}}},
        {.name = "painted",
         .type = Text,
         .help = "name of a vertex attribute in [0, 1], as brush-weight paints: 0 keeps a "
                 "vertex, 1 smooths it"},
        {.name = "caps",
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
         .only_with = Condition{"caps", {"keep", "round"}}}};
}

SmoothingContext smoothing_context(const Scene& scene, Arguments& arguments, Json& report) {
    const Surface& surface = surface_of(scene);
    static_cast<void>(given_stack_axis(arguments));
    SmoothingContext context;
    context.constraint = constraint_part(scene, arguments);
    static_cast<void>(surface.topology->rings());  // what making them has taken is not needed again
    release_kept_memory();
    const std::vector<Cap> caps = caps_of(surface, arguments);
    const std::vector<std::uint8_t> on_caps = cap_vertices(caps, surface.vertex_count());
    const bool round = arguments.text("caps") == "round";
    context.start =
        round ? std::make_shared<const Positions>(rounded_caps(surface, caps)) : surface.positions;
    context.fixed = round ? std::vector<std::uint8_t>() : on_caps;
    report["caps"] = caps.size();
    report["cap_vertices_kept"] = round ? 0 : std::ranges::count(on_caps, 1);
    if (arguments.flag("staircase"))
        weigh(context.weights, staircase_part(scene, surface, on_caps, arguments, report),
              "staircase", report);
    if (arguments.text("distance") != "none")
        weigh(context.weights, distance_part(scene, surface, arguments, report), "distance",
              report);
    if (const auto painted = arguments.optional_text("painted"))
        weigh(context.weights, painted_part(surface, *painted), "painted", report);
    if (round && !context.weights.empty())
        for (std::size_t v = 0; v < on_caps.size(); ++v)
            if (on_caps[v] != 0) context.weights[v] = 1.0;
    return context;
}

}  // namespace vesselbench
