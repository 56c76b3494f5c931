#include "workbench/case/checked_arguments.h"

#include "geometry/kernel/errors.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/operation.h"

namespace vesselbench {

void GivenArguments::set(const std::string& name, const Value& value) {
    const Parameter& parameter = find_parameter(*operation_, name);
    try {
        values_.set(name, checked_value(parameter, value));
    } catch (const UsageError& error) {
        throw UsageError(operation_->name + ": " + error.what());
    }
}

void GivenArguments::set(const GivenArguments& more) {
    for (const auto& [name, value] : more->values()) values_.set(name, value);
}

GivenArguments given_arguments(const Operation& operation, const Arguments& given) {
    for (const auto& [name, value] : given.values())
        static_cast<void>(find_parameter(operation, name));
    GivenArguments result(operation);
    for (const Parameter& parameter : operation.parameters)
        if (const auto at = given.values().find(parameter.name); at != given.values().end())
            result.set(parameter.name, at->second);
    return result;
}

Arguments with_records(const Operation& operation, Arguments stored) {
    for (const Parameter& parameter : operation.parameters) {
        if (parameter.type != ParameterType::Records || !stored.has(parameter.name)) continue;
        const Value value = stored.values().at(parameter.name);
        if (std::holds_alternative<Records>(value)) continue;
        try {
            stored.set(parameter.name, checked_value(parameter, value));
        } catch (const UsageError&) {  // said when it runs
        }
    }
    return stored;
}

void check_complete(const GivenArguments& given) {
    for (const Parameter& parameter : given.operation().parameters)
        if (parameter.required && !parameter.default_value && !given->has(parameter.name))
            throw UsageError(given.operation().name + ": parameter '" + parameter.name +
                             "' is required: " + parameter.help);
}

CheckedArguments checked_arguments(const GivenArguments& given) {
    check_complete(given);
    Arguments all = given;
    for (const Parameter& parameter : given.operation().parameters)
        if (parameter.default_value && !all.has(parameter.name))
            all.set(parameter.name, checked_value(parameter, *parameter.default_value));
    return CheckedArguments(std::move(all));
}

CheckedArguments checked_arguments(const Operation& operation, const Arguments& given) {
    return checked_arguments(given_arguments(operation, given));
}

}  // namespace vesselbench
