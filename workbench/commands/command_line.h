#pragma once

#include <stop_token>

namespace vesselbench {

/// Parses the command line and runs the command it names. Results go to stdout, progress and
/// remarks to stderr.
/// \param stop ends the command early, as if the user had cancelled it
/// \return the exit code of the command
/// \throw UsageError for wrong usage, and what the command throws (geometry/kernel/errors.h)
int run_command_line(int argc, char** argv, const std::stop_token& stop);

}  // namespace vesselbench
