#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"
#include "workbench/commands/shell/command_rows.h"

namespace vesselbench {

/// vesselbench.1, in the macros of man(7): commands with their options, the operations, exit codes.
[[nodiscard]] std::string manual_page(std::span<const CommandRow> commands,
                                      std::span<const Operation> operations);

}  // namespace vesselbench
