#pragma once

#include <string>

#include "geometry/progress.h"

namespace vesselbench {

// One function per command of the command line; each writes its result to stdout and throws the
// classes of geometry/errors.h. The options are what the command line's parser found.

struct OperationsOptions {
    std::string name;  ///< of one operation; empty: all of them
    bool json = false;
    bool markdown = false;  ///< the page docs/operations.md
};

/// Prints the operation table, or one operation with its parameters.
void list_operations(const OperationsOptions& options);

}  // namespace vesselbench
