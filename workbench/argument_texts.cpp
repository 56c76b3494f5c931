#include "workbench/argument_texts.h"

#include <algorithm>

#include "geometry/errors.h"
#include "workbench/near_names.h"

namespace vesselbench {

namespace {

const Parameter& parameter_of(const Operation& operation, const std::string& name) {
    std::vector<std::string> names;
    for (const Parameter& parameter : operation.parameters) {
        if (parameter.name == name) return parameter;
        names.push_back(parameter.name);
    }
    const std::string takes = names.empty() ? "it takes none" : "it takes " + joined(names);
    throw UsageError(operation.name + " has no parameter '" + name + "'" +
                     did_you_mean(name, names) + " (" + takes + ")");
}

}  // namespace

Arguments arguments_from_texts(const Operation& operation, std::span<const std::string> texts) {
    Arguments arguments;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw UsageError("'" + text + "' is not of the form parameter=value");
        const std::string name = text.substr(0, equals);
        const Parameter& parameter = parameter_of(operation, name);
        if (arguments.has(name))
            throw UsageError(operation.name + ": parameter '" + name + "' is given twice");
        try {
            arguments.set(name, parse_value(parameter, text.substr(equals + 1)));
        } catch (const UsageError& error) {
            throw UsageError(operation.name + ": " + error.what());
        }
    }
    return arguments;
}

std::string argument_summary(const Operation& operation, const Arguments& arguments) {
    std::string summary;
    for (const Parameter& parameter : operation.parameters) {
        const auto found = arguments.values().find(parameter.name);
        if (found == arguments.values().end() || found->second == parameter.default_value) continue;
        summary += (summary.empty() ? "" : " ") + parameter.name + "=" + to_text(found->second);
    }
    return summary;
}

}  // namespace vesselbench
