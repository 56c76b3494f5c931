#pragma once

#include <filesystem>
#include <vector>

#include "workbench/case/operation.h"
#include "workbench/project/project.h"

namespace vesselbench {

/// The arguments with files named without their folders: what may enter a project.
[[nodiscard]] Arguments without_folders(const Operation& operation, const Arguments& arguments);

/// The files that the arguments name, with their content's hash.
/// \param folder of the project; `place` is relative to it.
/// \throw IoError if one cannot be read
[[nodiscard]] std::vector<SourceFile> source_files(const Operation& operation,
                                                   const Arguments& arguments,
                                                   const std::filesystem::path& folder);

/// Finds recorded files again: where they were, beside the project, or in the current folder; only
/// one of the same content counts. Paths that exist stay as they are.
/// \throw IoError that names the file if there is none
[[nodiscard]] Arguments with_found_files(const Operation& operation, const Arguments& arguments,
                                         const std::vector<SourceFile>& sources,
                                         const std::filesystem::path& folder);

/// True if the operation reads files with these arguments.
[[nodiscard]] bool reads_files(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
