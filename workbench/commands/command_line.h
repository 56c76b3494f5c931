#pragma once

#include <stop_token>

#include "workbench/commands/failure.h"

namespace vesselbench {

/// Parses the command line and runs the command it names. Results go to stdout, progress and
/// remarks to stderr.
/// \param stop ends the command early, as if the user had cancelled it
/// \param command receives what the arguments say of it, before anything can fail
/// \return the exit code of the command
/// \throw UsageError for wrong usage, and what the command throws (geometry/kernel/errors.h)
int run_command_line(int argc, char** argv, const std::stop_token& stop, FailedCommand& command);

}  // namespace vesselbench
