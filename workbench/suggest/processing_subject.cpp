#include "workbench/suggest/processing_subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "meshing/remeshing/local_radius.h"
#include "meshing/remeshing/sizing_field.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

namespace {

constexpr double kMostTriangles = 4e6;  // of a result: a search must end

std::vector<SearchParameter> of_decimate(const Surface&, bool) {
    SearchParameter share{.name = "share", .unit = "-", .values = {0.02}, .coarse = 4, .idle = 1.0};
    for (int twentieths = 1; twentieths <= 20; ++twentieths)
        share.values.push_back(twentieths / 20.0);
    return {share};
}

std::vector<SearchParameter> of_remesh(const Surface& surface, bool all_parameters) {
    const double radius = usual_radius(surface, local_radii(surface, nullptr));
    SearchParameter edge{.name = "edge", .unit = "mm", .values = {}, .coarse = 3};
    for (const double factor :  // 45 ... 9 triangles around, as the operation's 0.28 makes 22
         {0.14, 0.17, 0.2, 0.24, 0.28, 0.33, 0.4, 0.5, 0.6, 0.7}) {
        const double length = three_digits(factor * radius);
        const double triangle = std::sqrt(3.0) / 4.0 * length * length;
        if (area(surface) / triangle <= kMostTriangles) edge.values.push_back(length);
    }
    if (edge.values.empty())
        throw InvalidInput(
            "remesh: the vessel is so thin for its area that every edge length in question makes "
            "more than 4 million triangles");
    if (!all_parameters) {
        edge.values.insert(edge.values.begin(), 0.0);
        edge.idle = 0.0;  // the surface's triangles may be better than any
        return {edge};
    }
    return {
        edge,
        {.name = "gradation", .unit = "-", .values = {1.1, 1.2, 1.3, 1.5, 1.75, 2.0, 2.5, 3.0}}};
}

std::vector<SearchParameter> of_subdivide(const Surface& surface, bool) {
    SearchParameter iterations{
        .name = "iterations", .unit = "", .values = {0.0, 1.0}, .coarse = 1, .idle = 0.0};
    auto triangles = 16.0 * static_cast<double>(surface.triangle_count());
    for (int i = 2; i <= 3 && triangles <= kMostTriangles; ++i, triangles *= 4.0)
        iterations.values.push_back(i);
    return {iterations};
}

/// How the parameters of an operation are searched.
struct SearchedOperation {
    const char* name;
    ScoreForm score;
    std::vector<SearchParameter> (*parameters)(const Surface& surface, bool all_parameters);
    std::vector<std::string> rivals;  ///< parameters that stand in for those searched
    bool strong_is_first = false;     ///< the smallest value of the first parameter changes most
};

const std::array<SearchedOperation, 3>& table() {
    static const std::array<SearchedOperation, 3> kTable = {
        {{"decimate", ScoreForm::Compact, &of_decimate, {"triangles"}, true},
         {"remesh", ScoreForm::Compact, &of_remesh, {"min_edge", "max_edge"}},
         {"subdivide", ScoreForm::Default, &of_subdivide, {}}}};
    return kTable;
}

const SearchedOperation& searched(const Operation& operation) {
    const auto found =
        std::ranges::find_if(table(), [&](const auto& row) { return row.name == operation.name; });
    if (found == table().end())
        throw UsageError("--operation: the parameters of " + operation.name +
                         " cannot be searched; of smooth, " + joined(searched_operations(), ", ") +
                         " they can");
    return *found;
}

/// The change that graphs measure by: the first parameter's extreme value, the others' own.
StrongChange strong_change(const Operation& operation, const Arguments& arguments,
                           const SearchSpace& space) {
    const SearchParameter& first = space.parameters.front();
    const double value =
        searched(operation).strong_is_first ? first.values.front() : first.values.back();
    StrongChange strong{{value}, operation.name + " " + first.name + "=" + formatted(value, "%g")};
    for (std::size_t i = 1; i < space.parameters.size(); ++i)
        strong.set.push_back(arguments.real(space.parameters[i].name));
    return strong;
}

/// The same scene and resolved arguments as a whole run.
Outcome run_without_figures(const Operation& operation, const Scene& scene,
                            const Arguments& arguments, const Progress& progress) {
    Operation bare = operation;
    if (bare.run_bare != nullptr) bare.run = bare.run_bare;
    Progress own = progress;
    return run_operation(bare, scene, arguments, own);
}

double share_of_triangles(const Scene& after, const Scene& before) {
    return static_cast<double>(surface_of(after).triangle_count()) /
           static_cast<double>(surface_of(before).triangle_count());
}

}  // namespace

std::vector<std::string> searched_operations() {
    std::vector<std::string> names;
    for (const SearchedOperation& row : table()) names.emplace_back(row.name);
    return names;
}

ScoreForm usual_score_of(const Operation& operation) {
    return searched(operation).score;
}

SearchSpace processing_space(const Operation& operation, const Surface& surface,
                             const Arguments& given, bool all_parameters) {
    const SearchedOperation& how = searched(operation);
    SearchSpace space{.parameters = how.parameters(surface, all_parameters)};
    for (const std::string& rival : how.rivals)
        if (given.has(rival))
            throw UsageError(operation.name + ": " + rival + " cannot be given here, where " +
                             space.parameters.front().name + " is searched");
    return space;
}

void set_values(Arguments& arguments, const Operation& operation, const SearchSpace& space,
                const ParameterSet& set) {
    for (std::size_t i = 0; i < set.size(); ++i) {
        const std::string& name = space.parameters[i].name;
        if (find_parameter(operation, name).type == ParameterType::Integer)
            arguments.set(name, static_cast<std::int64_t>(std::lround(set[i])));
        else
            arguments.set(name, set[i]);
    }
}

Surface processed_with(const Operation& operation, const Scene& scene, const Arguments& arguments,
                       const SearchSpace& space, const ParameterSet& set,
                       const Progress& progress) {
    if (does_nothing(space, set)) return surface_of(scene);
    Arguments changed = arguments;
    set_values(changed, operation, space, set);
    return surface_of(run_without_figures(operation, scene, changed, progress).scene);
}

std::shared_ptr<MeasureSource> processing_table(const Operation& operation, const Scene& scene,
                                                const Arguments& arguments,
                                                const SearchSpace& space) {
    const auto process = [&operation, scene, arguments, space](
                             const ParameterSet& set,
                             const Progress& progress) -> std::optional<Surface> {
        try {
            Surface result = processed_with(operation, scene, arguments, space, set, progress);
            if (area(result) > 0.0) return result;
            return std::nullopt;
        } catch (const AlgorithmFailure&) {
            return std::nullopt;
        }
    };
    return std::make_shared<ProcessingTable>(
        surface_of(scene), process,
        [space](const ParameterSet& set) { return does_nothing(space, set); },
        strong_change(operation, arguments, space));
}

ParameterSet processing_set(const Operation& operation, const Scene& scene,
                            const Arguments& arguments, const SearchSpace& space,
                            const Progress& progress) {
    std::optional<Outcome> outcome;
    ParameterSet set;
    for (const SearchParameter& parameter : space.parameters) {
        std::optional<double> value = arguments.optional_real(parameter.name);
        if (!value) {
            if (!outcome) outcome = run_without_figures(operation, scene, arguments, progress);
            value = outcome->resolved.optional_real(parameter.name);
        }
        // Only decimate leaves its share open, where max_error alone decides.
        set.push_back(value ? *value : share_of_triangles(outcome->scene, scene));
    }
    return set;
}

}  // namespace vesselbench
