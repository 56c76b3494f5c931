#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds the command that checks, compares and lists recipes.
void add_recipe_commands(CommandLine& line);

}  // namespace vesselbench
