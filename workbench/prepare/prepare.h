#pragma once

#include <span>
#include <string>
#include <vector>

#include "workbench/prepare/apply_recipe.h"
#include "workbench/prepare/prepare_options.h"
#include "workbench/report/report_html.h"
#include "workbench/session/session.h"

namespace vesselbench {

struct PrepareSummary {
    std::vector<std::string> products;  ///< names of the files and folders written
    std::vector<Diagnostic> warnings;   ///< all, as in report.json
    std::vector<std::string> not_met;   ///< requirements that the model misses, with their limits
    std::string print;                  ///< of a print: whether it is printable, or why not
};

/// Turns the input into a CFD or print model: a project with one edit per entry of the recipe,
/// then surface.vtp, surface.stl, report.json, report.html and the product's files. Results appear
/// only when all of them are complete. Files of others that have their names are kept under another
/// one. An earlier project in the folder is kept so as well, or resumed: the entries of the recipe
/// that have no edit in it are applied (resumed_recipe), whatever else was edited meanwhile. One
/// project holds the models of several purposes, which share its steps 1-3.
/// \throw UsageError, InvalidInput, IoError, AlgorithmFailure, Cancelled; the project then keeps
/// the edits that were done; there is no project if the input cannot be loaded or repaired
PrepareSummary prepare(const PrepareOptions& options, const Teller& tell, const Progress& progress);

/// Creates a project whose first edit loads the input, and keeps it open. Nothing is left of the
/// project if the input cannot be loaded.
/// \throw IoError if the file exists; what loading throws
[[nodiscard]] Session start_project(const std::filesystem::path& project, const Input& input,
                                    SessionOptions options, const Teller& tell,
                                    const Progress& progress);

/// The same for the command line.
/// \param author of the edits; empty: the login name
/// \throw IoError if the file exists
void new_project(const std::filesystem::path& project, const InputOptions& options,
                 const std::string& author, const Teller& tell, const Progress& progress);

}  // namespace vesselbench
