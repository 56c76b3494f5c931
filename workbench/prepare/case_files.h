#pragma once

#include <filesystem>

#include "workbench/case/json_fields.h"

namespace vesselbench {

// A case from a stranger must not lead to the user's other files: what it names is inside its
// folder, after links are resolved.

/// The description of a case, in its folder.
inline constexpr const char* kCaseFile = "case.json";

/// The project in the folder that `prepare` makes of a case.
inline constexpr const char* kProjectFile = "project.vbench";

/// The file that case.json names; empty if it has no such key.
/// \throw IoError if there is no such file, InvalidInput if it is outside the folder
[[nodiscard]] std::filesystem::path case_file(const std::filesystem::path& folder,
                                              JsonFields& fields, const char* key);

/// A recipe of a case with its files in the case's folder; what is no list of operations stays as
/// it is.
/// \throw InvalidInput if a file is outside the folder
[[nodiscard]] nlohmann::ordered_json recipe_in(const std::filesystem::path& folder,
                                               nlohmann::ordered_json recipe);

/// A recipe that names its files without their folders.
[[nodiscard]] nlohmann::ordered_json with_file_names(nlohmann::ordered_json recipe);

}  // namespace vesselbench
