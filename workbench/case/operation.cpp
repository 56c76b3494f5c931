#include "workbench/case/operation.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"

namespace vesselbench {

namespace {

/// Share of a live form's batch run that its scene takes; figures take the rest.
constexpr double kLiveShare = 0.8;

}  // namespace

std::string to_string(Step step) {
    static const std::array<const char*, 9> names = {"source",    "branches",  "local-repair",
                                                     "openings",  "smoothing", "deformation",
                                                     "remeshing", "product",   "review"};
    return names.at(static_cast<std::size_t>(step) - 1);
}

std::vector<std::string> step_names(const std::vector<Step>& steps) {
    std::vector<std::string> names;
    for (const Step step : steps) names.push_back(to_string(step));
    return names;
}

const Parameter& find_parameter(const Operation& operation, const std::string& name) {
    std::vector<std::string> names;
    for (const Parameter& parameter : operation.parameters) {
        if (parameter.name == name) return parameter;
        if (parameter.use != Use::Decision) names.push_back(parameter.name);
    }
    const std::string takes = names.empty() ? "it has none" : "its parameters are " + joined(names);
    throw UsageError(operation.name + " has no parameter '" + name + "'" +
                     did_you_mean(name, names) + " (" + takes + ")");
}

const Parameter* parameter_of(const Operation& operation, Meaning meaning) {
    const auto found = std::ranges::find(operation.parameters, meaning, &Parameter::meaning);
    return found == operation.parameters.end() ? nullptr : &*found;
}

Outcome run_here(const Operation& operation, const Scene& scene, const CheckedArguments& arguments,
                 Progress& progress) {
    if (operation.run != nullptr) return operation.run(scene, arguments, progress);
    Progress starting = progress.part(0.0, kLiveShare), figures = progress.part(kLiveShare, 1.0);
    return operation.start(scene, arguments, starting)->outcome(figures);
}

std::vector<Diagnostic> arguments_without_effect(const Operation& operation, const Arguments& given,
                                                 const Arguments& resolved) {
    std::vector<Diagnostic> warnings;
    for (const Parameter& parameter : operation.parameters) {
        if (!parameter.only_with || !given.has(parameter.name)) continue;
        const std::string& needed = parameter.only_with->parameter;
        const auto value = resolved.values().find(needed);
        const std::string text = value == resolved.values().end() ? "" : to_text(value->second);
        if (!holds(*parameter.only_with, find_parameter(operation, needed), text))
            warnings.push_back({.code = "argument-without-effect",
                                .operation = operation.name,
                                .words = {{"argument", parameter.name},
                                          {"condition", to_string(*parameter.only_with)}}});
    }
    return warnings;
}

}  // namespace vesselbench
