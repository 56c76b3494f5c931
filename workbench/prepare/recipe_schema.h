#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// The JSON Schema (draft 2020-12) of recipe files, made from the table of operations: editors
/// complete and check recipes by it. What it refuses, recipe_document() refuses as well; it cannot
/// see all that recipe_document() refuses.
[[nodiscard]] nlohmann::ordered_json recipe_schema();

}  // namespace vesselbench
