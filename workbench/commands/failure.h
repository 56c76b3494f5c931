#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/diagnostic_words.h"

namespace vesselbench {

/// What is known of a command when it fails.
struct FailedCommand {
    bool json = false;                 ///< --json was given
    std::optional<std::int64_t> edit;  ///< that it names (EDIT); none: no such argument
    Audience audience = {};            ///< what its reader knows
    std::string refused = {};  ///< JSON of its diagnostics with commands; empty: none has any
};

/// Why a command failed.
struct Failure {
    std::string text;
    int code = 1;  ///< exit code
    std::vector<Diagnostic> diagnostics = {};
    bool cancelled = false;  ///< by a signal
};

/// Writes the failure's line to stderr; with --json also a JSON document to stdout: error, code,
/// and edit, diagnostics and cancelled if there are any.
/// \return the exit code
int report_failure(const Failure& failure, const FailedCommand& command);

}  // namespace vesselbench
