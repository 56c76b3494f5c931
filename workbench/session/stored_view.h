#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// Keeps how a window shows a project's model, in the project file. It says nothing of the case: the
/// record neither binds it nor has an entry for it.
/// \param text JSON
/// \throw IoError if the project cannot be written
void store_view(const std::filesystem::path& project, const std::string& text);

/// That text; empty: the project has none.
/// \throw IoError, InvalidInput if it cannot be read
[[nodiscard]] std::string stored_view(const std::filesystem::path& project);

}  // namespace vesselbench
