#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds the command that prints a shell's completions, and the hidden one that prints the manual.
void add_shell_commands(CommandLine& line);

}  // namespace vesselbench
