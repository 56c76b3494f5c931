#include "workbench/suggest/processing_subject.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/operations/table.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

namespace {

/// How the parameters of an operation whose whole runs are compared are searched.
const OperationSearch& searched(const Operation& operation) {
    if (operation.search.parameters != nullptr) return operation.search;
    throw UsageError("--operation: the parameters of " + operation.name +
                     " cannot be searched; of " + joined(searched_operations(), ", ") + " can");
}

SearchParameter search_parameter(const Operation& operation, SearchedParameter parameter) {
    const std::string& unit = find_parameter(operation, parameter.name).unit;
    return {.name = std::move(parameter.name),
            .unit = unit,
            .values = std::move(parameter.values),
            .coarse = parameter.coarse,
            .idle = parameter.idle};
}

/// The change that scales graphs: the first parameter's extreme value, the others unchanged.
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

/// The value of a parameter that neither the arguments nor the operation has decided.
double value_if_open(const Operation& operation, const std::string& name, const Surface& before,
                     const Surface& after) {
    for (const SearchedParameter& parameter : searched(operation).parameters(before, true))
        if (parameter.name == name && parameter.value_if_open != nullptr)
            return parameter.value_if_open(before, after);
    throw std::logic_error(operation.name + " has left its parameter " + name + " open");
}

}  // namespace

std::vector<std::string> searched_operations() {
    return searched_operations([](const OperationSearch& search) { return search.possible(); });
}

std::vector<std::string> searched_operations(bool (*has)(const OperationSearch&)) {
    std::vector<std::string> names;
    for (const Operation& operation : operation_table())
        if (has(operation.search)) names.push_back(operation.name);
    return names;
}

bool counts_triangles(const OperationSearch& search) {
    return search.counts_triangles;
}

bool searches_filter(const OperationSearch& search) {
    return search.smoothing != nullptr;
}

ScoreForm usual_score_of(const Operation& operation) {
    return searched(operation).counts_triangles ? ScoreForm::Compact : ScoreForm::Default;
}

void check_rivals(const Operation& operation, const Arguments& given) {
    for (const std::string& rival : searched(operation).rivals)
        if (given.has(rival))
            throw UsageError(operation.name + ": " + rival +
                             " cannot be given here, because it replaces what is searched");
}

SearchSpace processing_space(const Operation& operation, const Surface& surface,
                             const Arguments& given, bool all_parameters) {
    const OperationSearch& how = searched(operation);
    check_rivals(operation, given);
    SearchSpace space;
    for (SearchedParameter& parameter : how.parameters(surface, all_parameters))
        space.parameters.push_back(search_parameter(operation, std::move(parameter)));
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
    return surface_of(
        run_without_figures(operation, scene, checked_arguments(operation, changed), progress)
            .scene);
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
            if (!outcome)
                outcome = run_without_figures(operation, scene,
                                              checked_arguments(operation, arguments), progress);
            value = outcome->resolved.optional_real(parameter.name);
        }
        set.push_back(value ? *value
                            : value_if_open(operation, parameter.name, surface_of(scene),
                                            surface_of(outcome->scene)));
    }
    return set;
}

}  // namespace vesselbench
