#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "workbench/case/operation.h"
#include "workbench/project/project.h"

namespace vesselbench {

/// Paths of files that were read, by their SHA-256.
using ReadFiles = std::map<std::string, std::filesystem::path>;

/// Where files may be.
struct FilePlaces {
    std::filesystem::path folder;  ///< of the project; empty: none
    ReadFiles read = {};           ///< by this process
};

/// Adds the sources of an edit.
/// \param located the arguments with which they were read
void remember(ReadFiles& read, const std::vector<SourceFile>& sources, const Arguments& located);

/// The arguments with file names without their folders, as they may enter a project; a folder is
/// called "dicom-slices".
[[nodiscard]] Arguments without_folders(const Operation& operation, const Arguments& arguments);

/// The files named in the arguments, with the hash of their content.
/// \param folder of the project; `place` is relative to it, and empty for files outside it.
/// \throw IoError if one cannot be read
[[nodiscard]] std::vector<SourceFile> source_files(const Operation& operation,
                                                   const Arguments& arguments,
                                                   const std::filesystem::path& folder);

/// \throw InvalidInput if a stored argument names a file with its folder: what vesselbench stores
/// never does
void require_bare_files(const Operation& operation, const Arguments& stored);

/// Finds recorded files again: in their old place inside the project's folder, beside the project,
/// beside its folder (as `prepare FILE --out FOLDER` leaves it), in the current folder, or where
/// this process has read them; only the same content counts. Existing paths are kept. \throw
/// IoError that names the file if there is none
[[nodiscard]] Arguments with_found_files(const Operation& operation, const Arguments& arguments,
                                         const std::vector<SourceFile>& sources,
                                         const FilePlaces& places);

/// True if the operation reads files with these arguments.
[[nodiscard]] bool reads_files(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
