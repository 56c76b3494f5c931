#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds the commands that measure, draw or judge surfaces.
void add_measuring_commands(CommandLine& line);

}  // namespace vesselbench
