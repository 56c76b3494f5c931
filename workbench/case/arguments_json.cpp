#include "workbench/case/arguments_json.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"

namespace vesselbench {

GivenArguments arguments_from_json(const Operation& operation,
                                   const nlohmann::ordered_json& object) {
    if (!object.is_object())
        throw UsageError("the arguments of " + operation.name + " are not a JSON object");
    Arguments given;
    for (const auto& [name, json] : object.items())
        given.set(name, value_from_json("parameter '" + name + "'", json));
    return given_arguments(operation, given);
}

}  // namespace vesselbench
