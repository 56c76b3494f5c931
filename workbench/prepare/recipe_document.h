#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "workbench/prepare/recipe_fault.h"

namespace vesselbench {

/// A recipe as it is written and shared: JSON with comments, // to the end of a line and /* */.
/// Either the list of entries alone, or an object, of whose keys all are optional:
///
///     "$schema": for editors              "title", "description": texts
///     "for": purpose or [purposes]        "entries": the list, as recipe_from_json() reads it
///     "on": name of a bundled recipe      "change": [{"operation", "step", "arguments"}, ...]
///
/// With "on", the recipe is the bundled one with changes: each replaces arguments in all of its
/// entries of that operation, in that step or in any. Then follow "entries", each behind those of
/// its step.
struct RecipeDocument {
    std::string name;  ///< of the bundled recipe, or of the file without its folder
    std::string title, description;
    std::vector<std::string> purposes;  ///< that it is made for; empty: any
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    std::string text;  ///< as it was written, with its comments
};

/// The bundled recipe that `prepare` uses where none is given.
inline constexpr const char* kDefaultRecipe = "prepare";

/// Reads the text of a recipe, and checks all of it, whatever the use of its entries.
/// \throw UsageError that names the first mistake, and how many there are
[[nodiscard]] RecipeDocument recipe_document(const std::string& text, const std::string& name);

/// The same without throwing: what is wrong is left out.
/// \param faults receives everything that is wrong, by line
[[nodiscard]] RecipeDocument read_recipe(const std::string& text, const std::string& name,
                                         RecipeFaults& faults);

/// "line 3, entry 2: there is no operation ..."
[[nodiscard]] std::string text_of(const RecipeFault& fault);

[[nodiscard]] std::vector<std::string> bundled_recipe_names();

[[nodiscard]] bool is_bundled_recipe(const std::string& name);

/// \throw UsageError that lists the bundled recipes if there is none of this name
[[nodiscard]] RecipeDocument bundled_recipe(const std::string& name);

/// The text of the recipe that a user names: a bundled one, or a file. A file with the name of a
/// bundled recipe is named with its folder: ./tree-cfd.
/// \throw UsageError if there is neither, IoError or InvalidInput if the file cannot be read
[[nodiscard]] std::string recipe_text(const std::string& name_or_file);

/// The recipe that a user names.
/// \throw as recipe_document() and recipe_text()
[[nodiscard]] RecipeDocument find_recipe(const std::string& name_or_file);

/// \throw UsageError unless the recipe is made for the purpose
void require_purpose(const RecipeDocument& recipe, const std::string& purpose);

}  // namespace vesselbench
