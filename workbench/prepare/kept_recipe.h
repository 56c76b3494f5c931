#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

/// Keeps the text of the recipe that was given for a purpose in the project, so that what is made
/// of the project later follows it, too. Of files that it names, only the name is kept: a project
/// does not say what other folders are called.
/// \throw IoError, InvalidInput if the project cannot be read or written
void keep_recipe(const std::filesystem::path& project, const std::string& purpose,
                 const RecipeDocument& recipe);

/// The text of the recipe that was given for a purpose; empty: none was.
/// \throw IoError, InvalidInput if the project cannot be read
[[nodiscard]] std::string kept_recipe_text(const std::filesystem::path& project,
                                           const std::string& purpose);

/// The purposes for which recipes are kept.
/// \throw IoError, InvalidInput if the project cannot be read
[[nodiscard]] std::vector<std::string> kept_purposes(const std::filesystem::path& project);

/// Puts the kept recipes in place of the input's own, each for its purpose. Their files are looked
/// for in the case's folder, or beside the project.
/// \throw IoError, InvalidInput if the project cannot be read
void take_kept_recipes(Input& input, const std::filesystem::path& project);

}  // namespace vesselbench
