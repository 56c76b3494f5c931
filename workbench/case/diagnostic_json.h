#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// A diagnostic in the form used in reports and failures: code, place_mm (null: none), figures, and
/// remedies, each an operation and its arguments.
[[nodiscard]] nlohmann::ordered_json diagnostic_json(const Diagnostic& diagnostic);

}  // namespace vesselbench
