#pragma once

#include "workbench/commands/command_parser.h"

namespace vesselbench {

/// Adds the option --for, required.
void add_purpose(CLI::App& command, std::string& purpose);

/// Adds what a case may be given besides its input and its purpose: mask, units, recipe ...; the
/// manifest of a batch has a column for each of them.
void add_case_options(CLI::App& command, PrepareArguments& options);

/// Adds prepare, ends and new.
void add_preparing_commands(CommandLine& line);

}  // namespace vesselbench
