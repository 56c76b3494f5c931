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
    GivenArguments given;                     ///< also names the operation
    std::optional<Step> step = std::nullopt;  ///< none: the operation's usual step
    bool optional = false;  ///< if it cannot be done, a warning is given and the recipe continues
    bool unless_closed = false;  ///< skipped if the surface has no border at that point
    /// Skipped if such an edit was made, with these values among its resolved arguments.
    std::optional<GivenArguments> unless_made = std::nullopt;
    /// Replace some of the given ones if they cannot be done.
    std::optional<GivenArguments> otherwise = std::nullopt;
};

using Recipe = std::vector<RecipeEntry>;

/// The step of the edit that an entry becomes.
[[nodiscard]] Step step_of(const RecipeEntry& entry);

/// The use of a recipe: words that an entry's "when" may contain.
using RecipeUse = std::vector<std::string>;  ///< of "surface" or "image", "mask", and the purpose

/// Reads the entries of a recipe, a JSON list (recipe_document.h reads what else its file may say).
/// All of an entry's keys but the first are optional:
///
///     "operation": name           "arguments": {parameter: value}    "step": name
///     "optional": true|false      "otherwise": {parameter: value}    "unless_closed": true|false
///     "when": word or [words]     "unless_made": {"operation": name, "arguments": {...}}
///
/// An entry {"require": "accepted=2", "when": ...} is none of them: reviewers_required() reads it.
/// An entry is used if each word of its "when" is in `use`, and each word prefixed by "no-" is not.
/// The argument "$purpose" is the purpose's name: presets are named like purposes. The arguments of
/// all entries are checked, also of those that are not used; required ones may still be absent.
/// \throw UsageError that names the entry and the mistake
[[nodiscard]] Recipe recipe_from_json(const nlohmann::ordered_json& list, const RecipeUse& use);

/// The number of reviewers who have to accept every edit before `prepare` writes its products: the
/// largest of a recipe's entries {"require": "accepted"} and {"require": "accepted=N"} that are
/// used; 0: it has none.
/// \throw UsageError that names the entry and the mistake
[[nodiscard]] std::size_t reviewers_required(const nlohmann::ordered_json& list,
                                             const RecipeUse& use);

/// The JSON list from which recipe_from_json() reads the same entries, whatever their use.
[[nodiscard]] nlohmann::ordered_json recipe_to_json(const Recipe& recipe);

/// The built-in recipe that `prepare` uses by default (DESIGN 2).
[[nodiscard]] Recipe default_recipe(const RecipeUse& use);

/// Replaces arguments by those of "operation.parameter=value" texts, in every entry of that
/// operation.
/// \throw UsageError if a text is not of that form, or the recipe has no such operation
void set_arguments(Recipe& recipe, std::span<const std::string> texts);

/// \throw UsageError that lists the steps if there is none of this name
[[nodiscard]] Step step_from(const std::string& name);

}  // namespace vesselbench
