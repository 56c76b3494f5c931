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

/// Those that still hold: what was made instead is as it was, and what was skipped was not made
/// since.
/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] std::vector<std::string> kept_warnings(const std::filesystem::path& project,
                                                     const std::vector<LogEntry>& log);

}  // namespace vesselbench
