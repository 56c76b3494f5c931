#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

/// How an operation is found by its name: the table of this build, or a test's own.
using OperationLookup = std::function<const Operation&(const std::string&)>;

/// How worker processes are started and bounded.
struct WorkerOptions {
    /// Command that runs worker_main(); empty: this very program with --worker.
    std::vector<std::string> command;
    std::chrono::seconds time_limit{3600};            ///< then the worker is killed
    std::size_t memory_limit = std::size_t{8} << 30;  ///< [bytes] of address space; 0: no limit
    /// Run those in a worker, too, that are not `isolated`, within no limits: a cancel then ends
    /// them at once, whatever they are doing. What was asked of a GPU still runs here: its driver
    /// takes more address space and time to start than a worker is worth, and it polls often.
    bool every_operation = false;
};

/// Runs an operation in a process of its own: the program starts itself anew (exec), scene in and
/// outcome out in the project's blob format. Cancelling kills it; whatever it does, the caller
/// lives. Parts of the scene that the operation did not change are shared with `scene` afterwards.
/// \param checked arguments as checked_arguments() leaves them
/// \throw what the operation throws (UsageError, InvalidInput, IoError, AlgorithmFailure,
/// Cancelled); InvalidInput if the worker crashed or ran out of its limits while it read a foreign
/// file, AlgorithmFailure if it did so otherwise
[[nodiscard]] Outcome run_in_worker(const Operation& operation, const Scene& scene,
                                    const Arguments& checked, const Progress& progress,
                                    const WorkerOptions& options = {});

/// The worker's side: reads one request, runs it, writes the outcome. \return the exit code
int worker_main(const OperationLookup& find);

}  // namespace vesselbench
