#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds prepare and new.
void add_preparing_commands(CommandLine& line);

}  // namespace vesselbench
