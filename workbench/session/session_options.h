#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "workbench/project/project.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

struct SessionOptions {
    std::string author;                             ///< of the edits; empty: the user's login name
    OperationLookup find;                           ///< required: finds operations by name
    WorkerOptions worker;                           ///< how operations run in worker processes
    std::size_t embed_limit = kEmbeddedImageBytes;  ///< [bytes] see there
    bool only_reads = false;  ///< opens a project beside whoever writes it, and leaves it as it is
    std::size_t scene_bytes = std::size_t{768}
                              << 20;  ///< scenes held in memory; others are re-read
};

/// How an edit enters the history.
struct EditOptions {
    std::optional<Step> step;               ///< none: the operation's usual step
    std::string variant = kDefaultVariant;  ///< for steps 4-8
    std::string author;                     ///< empty: the session's
    std::string note;
};

}  // namespace vesselbench
