#pragma once

#include <filesystem>
#include <vector>

#include "workbench/case/operation.h"
#include "workbench/project/project.h"

namespace vesselbench {

/// The arguments with file names without their folders, as they may enter a project.
[[nodiscard]] Arguments without_folders(const Operation& operation, const Arguments& arguments);

/// The files named in the arguments, with the hash of their content.
/// \param folder of the project; `place` is relative to it.
/// \throw IoError if one cannot be read
[[nodiscard]] std::vector<SourceFile> source_files(const Operation& operation,
                                                   const Arguments& arguments,
                                                   const std::filesystem::path& folder);

/// Finds recorded files again: in their old place, beside the project, or in the current folder;
/// only the same content counts. Existing paths are kept.
/// \throw IoError that names the file if there is none
[[nodiscard]] Arguments with_found_files(const Operation& operation, const Arguments& arguments,
                                         const std::vector<SourceFile>& sources,
                                         const std::filesystem::path& folder);

/// True if the operation reads files with these arguments.
[[nodiscard]] bool reads_files(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
