#pragma once

#include <string>

#include "workbench/worker/worker.h"

namespace vesselbench {

/// The operation of a name; null: of another version.
[[nodiscard]] const Operation* known_operation(const OperationLookup& find,
                                               const std::string& name);

}  // namespace vesselbench
