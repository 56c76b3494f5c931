#include "workbench/operations/shared/context_weights.h"

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Multiplies by one more kind of weights. \return its mean
double weigh(std::vector<double>& weights, std::vector<double> by) {
    const double its_mean = mean(by);
    if (weights.empty())
        weights = std::move(by);
    else
        for (std::size_t v = 0; v < by.size(); ++v) weights[v] *= by[v];
    return its_mean;
}

/// The stack axis given by the user; it must make sense even if it is not used.
std::optional<Vec3> given_stack_axis(const Arguments& arguments, const std::string& operation) {
    const auto axis = arguments.optional_point("stack_axis");
    if (!axis) return std::nullopt;
    const Vec3 direction = axis->stableNormalized();
    if (direction.allFinite() && direction.norm() > 0.5) return direction;
    throw UsageError(operation + ": stack_axis = " + to_text(*axis) +
                     " has no direction: give three numbers, not all of them 0");
}

/// Source of the stack axis: the user, the image, or the surface itself.
Vec3 stack_axis(const Scene& scene, const std::string& operation, ContextFinder& finder,
                Arguments& arguments, ContextFigures& figures) {
    if (const auto given = given_stack_axis(arguments, operation)) {
        figures.stack_axis_from = "argument";
        return *given;
    }
    const auto found = stack_axis_of(scene, finder.caps());
    if (!found)
        throw AlgorithmFailure(
            "the direction of the image stack is uncertain: the surface has no image and too few "
            "staircases; give stack_axis=x,y,z, or staircase=false");
    figures.stack_axis_confidence = found->confidence;
    figures.stack_axis_from = found->confidence ? "estimate" : "image";
    arguments.set("stack_axis", found->direction);
    return found->direction;
}

std::vector<double> staircase_part(const Scene& scene, const WeightSettings& settings,
                                   ContextFinder& finder, Arguments& arguments,
                                   ContextFigures& figures) {
    const Vec3 axis = stack_axis(scene, settings.operation, finder, arguments, figures);
    const std::vector<std::uint8_t>& caps = settings.caps;
    const StaircaseParameters parameters{
        .tau_theta = arguments.real("tau_theta"),
        .tau_max = arguments.real("tau_max"),
        .beta_min = settings.beta_min,
        .scaling = settings.thesis_scaling ? StaircaseScaling::Thesis : StaircaseScaling::TauMax,
        .caps = caps};
    StaircaseContext found = finder.staircases(axis, parameters);
    for (std::size_t v = 0; v < caps.size(); ++v)
        if (caps[v] != 0) found.weights[v] = settings.cap_weight;
    figures.stack_axis = axis;
    figures.staircase_vertices = found.vertices;
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
        throw AlgorithmFailure(
            operation +
            ": distance awareness needs a neighbour, but there is none: use load-neighbour");
    return names;
}

std::vector<Surface> neighbours_of(const Scene& scene, const std::vector<std::string>& names,
                                   const std::string& operation) {
    std::vector<Surface> neighbours;
    for (const std::string& name : names) {
        const auto found = scene.neighbours.find(name);
        if (found == scene.neighbours.end())
            throw AlgorithmFailure(operation + ": there is no neighbour '" + name +
                                   "': use load-neighbour, or name others with neighbours=");
        const Surface& surface = found->second;
        if (surface.empty())
            throw AlgorithmFailure(operation + ": the neighbour '" + name +
                                   "' has no triangles: load it again, or use distance=none");
        neighbours.push_back(surface);
    }
    return neighbours;
}

std::vector<double> distance_part(const Scene& scene, const std::string& operation,
                                  ContextFinder& finder, Arguments& arguments,
                                  ContextFigures& figures) {
    const std::string& name = arguments.text("distance");
    const std::vector<std::string> names = neighbour_names(scene, arguments, operation);
    arguments.set("neighbours",
                  joined(names, ","));  // fixed, so that neighbours loaded later change nothing
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
    if (figures.stack_axis) json["stack_axis"] = point_json(*figures.stack_axis);
    put("staircase_vertices", figures.staircase_vertices);
    put("mean_weight_staircase", figures.mean_weight_staircase);
    put("smallest_neighbour_distance_mm", figures.smallest_neighbour_distance);
    put("largest_neighbour_distance_mm", figures.largest_neighbour_distance);
    put("mean_weight_distance", figures.mean_weight_distance);
    put("mean_weight_painted", figures.mean_weight_painted);
    put("mean_weight", figures.mean_weight);
    return json;
}

std::string why_all_is_kept(const ContextFigures& figures, const Arguments& resolved) {
    std::ostringstream text;
    const double margin = resolved.real("margin");
    const double farthest = figures.largest_neighbour_distance.value_or(0.0);
    if (resolved.flag("staircase") && figures.staircase_vertices == 0)
        text << "the surface bends nowhere by more than tau_theta = "
             << to_text(resolved.real("tau_theta"))
             << "; a smaller value finds smoother staircases";
    else if (resolved.text("distance") == "margin" && margin >= farthest)
        text << "the whole surface is within the margin of " << margin
             << " mm; its farthest vertex is " << farthest << " mm from a neighbour";
    return text.str();
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
         .help = "direction across the image's slices, in patient coordinates; default: from the "
                 "image, or estimated from the surface",
         .only_with = when_staircase},
        {.name = "tau_theta",
         .unit = "-",
         .default_value = 0.7,
         .help = "how sharply a surface must bend across the slices to count as a staircase: 1 is "
                 "a right angle; smaller values find smoother staircases",
         .minimum = 0.0,
         .maximum = 1.0,
         .only_with = when_staircase},
        {.name = "tau_max",
         .unit = "mm",
         .default_value = 3.0,
         .help = "how far around staircases the " + action.doing +
                 " fades out; about one slice distance",
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
         .help = "preserve the surface near the structures of load-neighbour; the nearest vertex "
                 "gets no " +
                 action.doing +
                 ", the farthest vertex all of it; in between it grows linearly (linear), linearly "
                 "from a margin on (margin), or late and fast (exponential)",
         .choices = {"none", "linear", "margin", "exponential"}},
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
         .help =
             "name of a vertex attribute in [0, 1], as painted by brush-weight: vertices of 0 " +
             action.kept + ", 1 " + action.painted_one,
         .meaning = Meaning::Name}};
}

void check_stack_axis(const Arguments& arguments, const std::string& operation) {
    static_cast<void>(given_stack_axis(arguments, operation));
}

ContextWeights context_weights(const Scene& scene, const WeightSettings& settings,
                               ContextFinder& finder, Arguments& arguments) {
    const std::string& operation = settings.operation;
    check_stack_axis(arguments, operation);
    ContextWeights found;
    ContextFigures& figures = found.figures;
    if (arguments.flag("staircase"))
        figures.mean_weight_staircase =
            weigh(found.weights, staircase_part(scene, settings, finder, arguments, figures));
    if (arguments.text("distance") != "none")
        figures.mean_weight_distance =
            weigh(found.weights, distance_part(scene, operation, finder, arguments, figures));
    if (const auto painted = arguments.optional_text("painted"))
        figures.mean_weight_painted =
            weigh(found.weights, painted_part(surface_of(scene), *painted, operation));
    if (!found.weights.empty()) figures.mean_weight = mean(found.weights);
    return found;
}

}  // namespace vesselbench
