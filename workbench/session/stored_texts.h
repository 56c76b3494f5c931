#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// Keeps the recipes that a case brought along in its project file, which a session of this process
/// may have open.
/// \param recipes JSON
/// \throw IoError if the project cannot be written
void store_recipes(const std::filesystem::path& project, const std::string& recipes);

/// The recipes in a project file; empty: it has none, or cannot be read.
[[nodiscard]] std::string stored_recipes(const std::filesystem::path& project);

}  // namespace vesselbench
