#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workbench/prepare/recipe_run.h"

namespace vesselbench {

/// The warnings of a recipe in a project file, so that the report of a resumed preparation has
/// them, too.

/// \throw IoError if the project cannot be written
void keep_warning(const std::filesystem::path& project, const RecipeWarning& warning);

/// Those of a variant's model that still hold: what was made instead is as it was, and what was
/// skipped was not made since.
/// \param session that has the project open
/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] std::vector<Diagnostic> kept_warnings(const std::filesystem::path& project,
                                                    const Session& session,
                                                    const std::string& variant);

}  // namespace vesselbench
