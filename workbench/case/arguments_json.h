#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/operation.h"

namespace vesselbench {

/// JSON form of a value: true|false, number, text, [x,y,z], [1,2,3], [{"name": value, ...}, ...].
[[nodiscard]] nlohmann::ordered_json to_json(const Value& value);

/// The value that a JSON form gives, of no parameter's type: points are lists of numbers.
/// \param called the value in error texts: "parameter 'planes'"
/// \throw UsageError if it is no value's form
[[nodiscard]] Value value_from_json(const std::string& called, const nlohmann::ordered_json& json);

/// JSON object of the arguments, by parameter name.
[[nodiscard]] nlohmann::ordered_json to_json(const Arguments& arguments);

/// Reads and checks the JSON object of an operation's arguments.
/// \throw UsageError as given_arguments()
[[nodiscard]] GivenArguments arguments_from_json(const Operation& operation,
                                                 const nlohmann::ordered_json& object);

}  // namespace vesselbench
