#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "workbench/prepare/recipe_entry.h"

namespace vesselbench {

/// Reads the entries of a recipe, a JSON list (recipe_document.h reads what else its file may say).
/// All of an entry's keys but the first are optional:
///
///     "operation": name           "arguments": {parameter: value}    "step": name
///     "optional": true|false      "otherwise": {parameter: value}    "unless_closed": true|false
///     "when": word or [words]     "unless_made": {"operation": name, "arguments": {...}} or a list
///
/// An entry {"require": "accepted=2", "when": ...} is none of them: reviewers_required() reads it.
/// An entry is used if each word of its "when" is in `use`, and each word prefixed by "no-" is not.
/// The argument "$purpose" is the purpose's name: presets are named like purposes. "$mask" is the
/// method `wall` where a drawn mask is the vessel's wall and the entry has no argument of another
/// way to use it, else `auto`. The arguments of
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
/// operation. An entry does not replace them otherwise: what is asked for by name is made, or
/// refused. \throw UsageError if a text is not of that form, or the recipe has no such operation
void set_arguments(Recipe& recipe, std::span<const std::string> texts);

}  // namespace vesselbench
