#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"
#include "workbench/commands/shell/command_rows.h"

namespace vesselbench {

/// The script by which bash completes commands, options and their choices, operations and their
/// parameters, and files where none of these fits; for
/// /usr/share/bash-completion/completions/vesselbench.
[[nodiscard]] std::string bash_completion(std::span<const CommandRow> commands,
                                          std::span<const Operation> operations);

}  // namespace vesselbench
