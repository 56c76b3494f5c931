#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds the commands that edit a project, show its edits, or export its model.
void add_project_commands(CommandLine& line);

}  // namespace vesselbench
