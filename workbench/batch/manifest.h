#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "workbench/batch/batch_case.h"

namespace vesselbench {

/// What the cases of a batch may be given.
struct CaseColumns {
    std::vector<CaseOption> options;
    std::vector<CaseValue> shared;  ///< of all cases that do not have their own
};

/// Reads a manifest: CSV whose first record names the columns. `input` is the only one that is
/// required; `case` names the case, by default after its input; all others are options of
/// `prepare`, and "operation.parameter" as --set takes it. Several values of an option that may be
/// repeated are separated by ';'; a flag is yes or no. Paths are relative to the manifest.
/// \throw InvalidInput that names the line and the column; IoError if it cannot be read
[[nodiscard]] std::vector<BatchCase> cases_of_manifest(const std::filesystem::path& manifest,
                                                       const CaseColumns& columns);

/// One case for each file of a folder whose name is that of a readable format, and for each folder
/// in it with a case.json or DICOM slices; by name.
/// \param skipped receives the name of each other file
/// \throw InvalidInput if there is none; IoError if it cannot be read
[[nodiscard]] std::vector<BatchCase> cases_in_folder(
    const std::filesystem::path& folder, const CaseColumns& columns,
    const std::function<void(const std::string&)>& skipped);

/// True if the value of an option is a file: not labels, nor the name of a bundled recipe.
[[nodiscard]] bool names_file(const CaseOption& option, const std::string& text);

/// The name of a case made from an input, without folder and suffix, made plain.
[[nodiscard]] std::string case_name_of(const std::filesystem::path& input);

}  // namespace vesselbench
