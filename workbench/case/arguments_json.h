#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/operation.h"

namespace vesselbench {

/// JSON form of a value: true|false, number, text, [x,y,z], [1,2,3].
[[nodiscard]] nlohmann::ordered_json to_json(const Value& value);

/// JSON object of the arguments, by parameter name.
[[nodiscard]] nlohmann::ordered_json to_json(const Arguments& arguments);

/// Reads and checks the JSON object of an operation's arguments.
/// \throw UsageError as given_arguments()
[[nodiscard]] GivenArguments arguments_from_json(const Operation& operation,
                                                 const nlohmann::ordered_json& object);

}  // namespace vesselbench
