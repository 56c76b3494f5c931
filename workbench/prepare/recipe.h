#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/operation.h"

namespace vesselbench {

/// One edit of a recipe.
struct RecipeEntry {
    std::string operation;
    Arguments given;
    std::optional<Step> step;    ///< none: the operation's usual step
    bool optional = false;       ///< what cannot be done becomes a warning instead of the end
    bool unless_closed = false;  ///< left out where the surface has no border by then
    Arguments otherwise;         ///< replace some of the given ones if they cannot be done
};

using Recipe = std::vector<RecipeEntry>;

/// What a recipe is used for: each is a word that an entry's "when" may name.
using RecipeUse = std::vector<std::string>;  ///< of "surface" or "image", "mask", and the purpose

/// Reads a recipe, a JSON list of
///   {"operation": name, "arguments": {parameter: value}, "step": name, "optional": true|false,
///    "unless_closed": true|false, "otherwise": {parameter: value}, "when": word or list of words}
/// where everything but "operation" may be left out. An entry is used if each word of its "when" is
/// in `use`; a word with "no-" before it must not be.
/// \throw UsageError that names the entry and what is wrong with it
[[nodiscard]] Recipe recipe_from_json(const nlohmann::ordered_json& list, const RecipeUse& use);

/// The built-in recipe `prepare` follows unless it is told otherwise (DESIGN 2).
[[nodiscard]] Recipe default_recipe(const RecipeUse& use);

/// Replaces arguments by those of "operation.parameter=value" texts, in every entry of that
/// operation.
/// \throw UsageError if a text is not of that form, or the recipe has no such operation
void set_arguments(Recipe& recipe, std::span<const std::string> texts);

/// \throw UsageError that lists the steps if there is none of this name
[[nodiscard]] Step step_from(const std::string& name);

}  // namespace vesselbench
