#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// Texts of workbench/prepare/recipes/*.json by name, embedded at build time.
[[nodiscard]] const std::map<std::string, std::string>& builtin_recipe_texts();

}  // namespace vesselbench
