#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Reads and checks the JSON object of an operation's arguments.
/// \throw UsageError as given_arguments()
[[nodiscard]] GivenArguments arguments_from_json(const Operation& operation,
                                                 const nlohmann::ordered_json& object);

}  // namespace vesselbench
