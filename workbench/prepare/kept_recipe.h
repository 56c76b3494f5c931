#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "workbench/prepare/input.h"

namespace vesselbench {

/// Keeps the recipe that a file has given for a purpose in the project, so that what is made of the
/// project later follows it, too. Of files that it names, only the name is kept: a project does not
/// say what other folders are called.
/// \throw IoError, InvalidInput if the project cannot be read or written
void keep_recipe(const std::filesystem::path& project, const std::string& purpose,
                 nlohmann::ordered_json recipe);

/// Puts the kept recipes in place of the input's own, each for its purpose. Their files are looked
/// for in the case's folder, or beside the project.
/// \throw IoError, InvalidInput if the project cannot be read
void take_kept_recipes(Input& input, const std::filesystem::path& project);

}  // namespace vesselbench
