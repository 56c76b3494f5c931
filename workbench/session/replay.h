#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/session/edit_runner.h"

namespace vesselbench {

/// Result of replaying one edit.
struct ReplayEntry {
    EditRef edit;
    std::string operation;
    std::string variant;
    bool replayed = false;  ///< false: only the stored result's checksums were verified
    std::vector<std::string> differences;  ///< empty: same bits, or as `distance` says
    std::optional<double> distance;        ///< largest between vertices [mm], for results of a GPU
    /// Why it was not run again; or in what it changes more than its operation states.
    std::string note;
};

/// Runs each done edit of the current state again on its stored input, with its resolved arguments,
/// and compares with its stored result bit for bit.
[[nodiscard]] std::vector<ReplayEntry> replay(CaseStore& store, EditRunner& runner,
                                              const Progress& progress);

}  // namespace vesselbench
