#include "workbench/operations/shared/context_weights.h"

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wording.h"
#include "smoothing/context/distance_weights.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Adds one more kind of weights. \return its mean
double weigh(std::vector<double>& weights, std::vector<double> by, Combination how) {
    const double its_mean = mean(by);
    if (weights.empty())
        weights = std::move(by);
    else
        for (std::size_t v = 0; v < by.size(); ++v)
            weights[v] = combined_weight(weights[v], by[v], how);
    return its_mean;
}

/// The axes and thresholds, filled in.
StaircaseChoice decided_staircases(const Scene& scene, const std::string& operation,
                                   ContextFinder& finder, Arguments& arguments) {
    auto choice = staircase_choice(scene, finder, arguments);
    if (!choice)
        throw DiagnosedFailure({.code = "stack-axis-uncertain",
                                .operation = operation,
                                .remedies = {{.arguments = {{"stack_axis", ""}}},
                                             {.arguments = {{"staircase", "false"}}}}});
    if (choice->axes_from != "argument") arguments.set("stack_axis", choice->axis_value());
    arguments.set("tau_theta", choice->tau_theta);
    arguments.set("tau_max", choice->tau_max);
    return std::move(*choice);
}

std::vector<double> staircase_part(const Scene& scene, const WeightSettings& settings,
                                   ContextFinder& finder, Arguments& arguments,
                                   ContextWeights& into) {
    ContextFigures& figures = into.figures;
    StaircaseChoice choice = decided_staircases(scene, settings.operation, finder, arguments);
    const std::vector<std::uint8_t>& caps = settings.caps;
    const StaircaseParameters parameters{
        .tau_theta = choice.tau_theta,
        .tau_max = choice.tau_max,
        .beta_min = settings.beta_min,
        .scaling = settings.thesis_scaling ? StaircaseScaling::Thesis : StaircaseScaling::TauMax,
        .caps = caps};
    StaircaseContext found = finder.staircases(choice.axes, parameters);
    for (std::size_t v = 0; v < caps.size(); ++v)
        if (caps[v] != 0) found.weights[v] = settings.cap_weight;
    figures.stack_axis_confidence = choice.confidence;
    figures.stack_axis_from = choice.axes_from;
    if (choice.axes.size() == 1) figures.stack_axis = *choice.axes.begin();
    figures.decisions = std::move(choice.reasons);
    figures.staircase_vertices = found.vertices;
    into.stack_axes = std::move(choice.axes);
    return std::move(found.weights);
}

/// The names of the neighbours to consider: those given, or all that are loaded.
std::vector<std::string> neighbour_names(const Scene& scene, const Arguments& arguments,
                                         const std::string& operation) {
    std::vector<std::string> names;
    if (const auto given = arguments.optional_text("neighbours")) {
        std::istringstream list(*given);
        for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    } else {
        for (const auto& [name, surface] : scene.neighbours) names.push_back(name);
    }
    if (names.empty())
        throw DiagnosedFailure({.code = "no-neighbour",
                                .operation = operation,
                                .remedies = {{.operation = "load-neighbour"}}});
    return names;
}

std::vector<Surface> neighbours_of(const Scene& scene, const std::vector<std::string>& names,
                                   const std::string& operation) {
    std::vector<Surface> neighbours;
    for (const std::string& name : names) {
        const auto found = scene.neighbours.find(name);
        if (found == scene.neighbours.end())
            throw DiagnosedFailure(
                {.code = "no-such-neighbour",
                 .operation = operation,
                 .words = {{"neighbour", name}},
                 .remedies = {{.operation = "load-neighbour", .arguments = {{"name", name}}},
                              {.arguments = {{"neighbours", ""}}}}});
        const Surface& surface = found->second;
        if (surface.empty())
            throw DiagnosedFailure({.code = "neighbour-without-triangles",
                                    .operation = operation,
                                    .words = {{"neighbour", name}},
                                    .remedies = {{.operation = "load-neighbour"},
                                                 {.arguments = {{"distance", "none"}}}}});
        neighbours.push_back(surface);
    }
    return neighbours;
}

/// The same, fixed, so that neighbours loaded later change nothing.
std::vector<std::string> decided_neighbours(const Scene& scene, const std::string& operation,
                                            Arguments& arguments) {
    std::vector<std::string> names = neighbour_names(scene, arguments, operation);
    arguments.set("neighbours", joined(names, ","));
    return names;
}

std::vector<double> distance_part(const Scene& scene, const std::string& operation,
                                  ContextFinder& finder, Arguments& arguments,
                                  ContextFigures& figures) {
    const std::string& name = arguments.text("distance");
    const std::vector<std::string> names = decided_neighbours(scene, operation, arguments);
    const DistanceParameters parameters{.scaling = name == "margin" ? DistanceScaling::Margin
                                                   : name == "exponential"
                                                       ? DistanceScaling::Exponential
                                                       : DistanceScaling::Linear,
                                        .margin = arguments.real("margin"),
                                        .omega = arguments.real("omega")};
    NeighbourContext found = finder.neighbours(neighbours_of(scene, names, operation), parameters);
    figures.smallest_neighbour_distance = found.least;
    figures.largest_neighbour_distance = found.most;
    return std::move(found.weights);
}

std::vector<double> painted_part(const Surface& surface, const std::string& name,
                                 const std::string& operation) {
    const auto attribute = surface.attributes.find(name);
    if (attribute == surface.attributes.end())
        throw AlgorithmFailure(operation + ": the surface has no attribute '" + name +
                               "' to use as weights");
    for (const double weight : *attribute->second)
        if (!(weight >= 0.0 && weight <= 1.0))
            throw AlgorithmFailure(operation + ": the attribute '" + name +
                                   "' has values outside [0, 1]");
    return *attribute->second;
}

}  // namespace

Json context_json(const ContextFigures& figures) {
    Json json = Json::object();
    const auto put = [&](const char* key, const auto& figure) {
        if (figure) json[key] = *figure;
    };
    put("stack_axis_confidence", figures.stack_axis_confidence);
    if (!figures.stack_axis_from.empty()) json["stack_axis_from"] = figures.stack_axis_from;
    if (figures.stack_axis)
        json["stack_axis"] = point_json(*figures.stack_axis);
    else if (!figures.stack_axis_from.empty())
        json["stack_axis"] = "all";
    for (const auto& [argument, reason] : figures.decisions) json[argument + "_decided"] = reason;
    put("staircase_vertices", figures.staircase_vertices);
    put("mean_weight_staircase", figures.mean_weight_staircase);
    put("smallest_neighbour_distance_mm", figures.smallest_neighbour_distance);
    put("largest_neighbour_distance_mm", figures.largest_neighbour_distance);
    put("mean_weight_distance", figures.mean_weight_distance);
    put("mean_weight_painted", figures.mean_weight_painted);
    put("mean_weight", figures.mean_weight);
    return json;
}

std::optional<Diagnostic> why_all_is_kept(const ContextFigures& figures,
                                          const Arguments& resolved) {
    const double margin = resolved.real("margin");
    const double farthest = figures.largest_neighbour_distance.value_or(0.0);
    if (resolved.flag("staircase") && figures.staircase_vertices == 0)
        return Diagnostic{.code = "no-vertex-on-staircases",
                          .figures = {{"tau_theta", resolved.real("tau_theta")}},
                          .remedies = {{.arguments = {{"tau_theta", ""}}}}};
    if (resolved.text("distance") == "margin" && margin >= farthest)
        return Diagnostic{.code = "all-within-margin",
                          .figures = {{"margin_mm", margin}, {"farthest_mm", farthest}}};
    return std::nullopt;
}

Combination combination_from(const Arguments& arguments) {
    return arguments.text("combine") == "average" ? Combination::Average : Combination::Multiply;
}

std::vector<double> distances_from_neighbour(const Surface& neighbour, const Positions& positions) {
    return neighbour_distances(positions, {&neighbour, 1});
}

std::vector<double> signed_distances_from_neighbour(const Surface& neighbour,
                                                    const Positions& positions) {
    require_neighbours({&neighbour, 1});
    if (is_closed(neighbour)) return distance_to(neighbour).signed_distances(positions);
    std::vector<double> distances;
    for (const SurfacePoint& nearest : distance_to(neighbour).closest_points(positions))
        distances.push_back(nearest.distance);
    return distances;
}

double smallest_neighbour_distance(const Scene& scene, const Arguments& arguments,
                                   const std::string& operation, const Positions& positions) {
    const std::vector<std::string> names = neighbour_names(scene, arguments, operation);
    return std::ranges::min(neighbour_distances(positions, neighbours_of(scene, names, operation)));
}

std::vector<Parameter> staircase_parameter_table(const WeighedAction& action) {
    using enum ParameterType;
    const Condition when_staircase{"staircase", {"true"}};
    return {
        {.name = "staircase", .type = Flag, .default_value = false, .help = action.staircase_help},
        {.name = "stack_axis",
         .type = Point,
         .help = "direction across the image's slices, in patient coordinates; all: the three axes "
                 "of the voxels; default: from the image or the surface's triangles, all for masks "
                 "whose voxels are nearly cubes",
         .choices = {"all"},
         .only_with = when_staircase},
        {.name = "tau_theta",
         .unit = "-",
         .help = "how sharply a surface must bend across the slices to count as a staircase: 1 is "
                 "a right angle; smaller values find smoother staircases; default: a little below "
                 "the step of one slice in the image's voxels, or of intensities what stands out "
                 "of the surface's own bends, if that is less",
         .minimum = 0.0,
         .maximum = 1.0,
         .only_with = when_staircase},
        {.name = "tau_max",
         .unit = "mm",
         .help = "how far around staircases the " + action.doing +
                 " fades out; default: the distance of the slices",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = when_staircase}};
}

std::vector<Parameter> distance_parameter_table(const WeighedAction& action) {
    using enum ParameterType;
    return {
        {.name = "distance",
         .type = Choice,
         .default_value = std::string("none"),
         .help = "preserve the surface near the neighbouring structures; the nearest vertex "
                 "gets no " +
                 action.doing +
                 ", the farthest vertex all of it; in between it grows linearly (linear), linearly "
                 "from a margin on (margin), or late and fast (exponential)",
         .choices = {"none", "linear", "margin", "exponential"}},
        {.name = "combine",
         .type = Choice,
         .default_value = std::string("multiply"),
         .help = "how the weights of staircases and distances are combined: multiply keeps what "
                 "either of them keeps; average also reduces staircases near neighbours",
         .choices = {"multiply", "average"},
         .only_with = Condition{"distance", {"linear", "margin", "exponential"}},
         .use = Use::Rare},
        {.name = "neighbours",
         .type = Text,
         .help = "names of the neighbours to consider, a,b,...; default: all that are loaded",
         .only_with = Condition{"distance", {"linear", "margin", "exponential"}},
         .meaning = Meaning::Names},
        {.name = "margin",
         .unit = "mm",
         .default_value = 2.0,
         .help = "vertices this close to a neighbour " + action.kept,
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"distance", {"margin"}}},
        {.name = "omega",
         .unit = "1/mm",
         .default_value = 0.06,
         .help =
             "how late the " + action.doing +
             " sets in: near 0 as with linear; larger values preserve more of the surface nearby",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"distance", {"exponential"}}},
        {.name = "painted",
         .type = Text,
         .help = "name of a vertex attribute in [0, 1], as a brush paints it: vertices of 0 " +
                 action.kept + ", 1 " + action.painted_one,
         .meaning = Meaning::Name}};
}

ContextWeights context_weights(const Scene& scene, const WeightSettings& settings,
                               ContextFinder& finder, Arguments& arguments) {
    const std::string& operation = settings.operation;
    check_stack_axis(arguments, operation);
    ContextWeights found;
    ContextFigures& figures = found.figures;
    if (arguments.flag("staircase"))
        figures.mean_weight_staircase =
            weigh(found.weights, staircase_part(scene, settings, finder, arguments, found),
                  Combination::Multiply);
    if (arguments.text("distance") != "none")
        figures.mean_weight_distance =
            weigh(found.weights, distance_part(scene, operation, finder, arguments, figures),
                  combination_from(arguments));
    if (found.stack_axes && combination_from(arguments) == Combination::Average)
        for (std::size_t v = 0; v < settings.caps.size(); ++v)
            if (settings.caps[v] != 0) found.weights[v] = settings.cap_weight;
    if (const auto painted = arguments.optional_text("painted"))
        figures.mean_weight_painted =
            weigh(found.weights, painted_part(surface_of(scene), *painted, operation),
                  Combination::Multiply);
    if (!found.weights.empty()) figures.mean_weight = mean(found.weights);
    return found;
}

void decide_weights(const Scene& scene, const std::string& operation, ContextFinder& finder,
                    Arguments& arguments) {
    check_stack_axis(arguments, operation);
    if (arguments.flag("staircase"))
        static_cast<void>(decided_staircases(scene, operation, finder, arguments));
    if (arguments.text("distance") != "none")
        static_cast<void>(decided_neighbours(scene, operation, arguments));
}

}  // namespace vesselbench
