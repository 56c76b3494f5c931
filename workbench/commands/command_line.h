#pragma once

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Parses the command line and runs the command it names. Results go to stdout, progress and
/// remarks to stderr.
/// \return the exit code of the command
/// \throw UsageError for wrong usage, and what the command throws (geometry/kernel/errors.h)
int run_command_line(int argc, char** argv, const Progress& progress);

}  // namespace vesselbench
