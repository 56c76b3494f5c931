#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/prepare/recipe_entry.h"
#include "workbench/prepare/recipe_fault.h"

namespace vesselbench {

/// The words that an entry's "when" may contain, each also with the prefix no-.
[[nodiscard]] std::vector<std::string> use_words();

/// True for a setting "operation.parameter=value" by which the mask is not the vessel's wall, but a
/// region for intensities, or another one is chosen.
[[nodiscard]] bool limits_region(std::string_view setting);

/// What an entry of a recipe says.
struct ReadEntry {
    bool used = true;                  ///< its "when" holds
    std::size_t reviewers = 0;         ///< asked for by a gate: {"require": "accepted"}
    std::optional<RecipeEntry> entry;  ///< none: a gate, or no known operation
};

/// Reads one entry as recipe_from_json() describes it.
/// \param place of the entry, RecipeFault::place
/// \param faults receives everything that is wrong about it; the rest is read
[[nodiscard]] ReadEntry read_entry(const nlohmann::ordered_json& json, const RecipeUse& use,
                                   const std::string& place, RecipeFaults& faults);

/// Reads {"operation": name, "step": name, "arguments": {...}} with no other keys.
/// \return none: it names no operation
[[nodiscard]] std::optional<RecipeEntry> read_change(const nlohmann::ordered_json& json,
                                                     const std::string& place,
                                                     RecipeFaults& faults);

}  // namespace vesselbench
