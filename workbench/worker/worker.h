#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Finds an operation by name: in the table of this build, or in a test's own.
using OperationLookup = std::function<const Operation&(const std::string&)>;

/// How workers are started and bounded; while reading files also by 256 MiB + 16 x their size.
struct WorkerOptions {
    /// Command that runs worker_main(); empty: this program with --worker.
    std::vector<std::string> command;
    std::chrono::seconds time_limit{3600};            ///< then the worker is killed
    std::size_t memory_limit = std::size_t{8} << 30;  ///< [bytes] of address space; 0: no limit
    /// Also run operations that are not `isolated` in a worker, without limits: a cancel then ends
    /// them at once, whatever they are doing. What declares that it stays here (GPU work) still
    /// runs in this process: its driver needs more address space and start-up time than a worker
    /// can offer, and it polls often.
    bool every_operation = false;
};

/// Runs an operation in a separate process: the program starts itself again (exec), with scene in
/// and outcome out in the project's blob format. Cancelling kills it; the caller survives whatever
/// it does. Parts of the scene that the operation did not change are shared with `scene`
/// afterwards.
/// \throw what the operation throws (UsageError, InvalidInput, IoError, AlgorithmFailure,
/// Cancelled); InvalidInput if the worker crashed or exceeded its limits while reading a foreign
/// file, otherwise AlgorithmFailure
[[nodiscard]] Outcome run_in_worker(const Operation& operation, const Scene& scene,
                                    const CheckedArguments& arguments, const Progress& progress,
                                    const WorkerOptions& options = {});

/// The worker's side: reads one request, runs it, writes the outcome. \return the exit code
int worker_main(const OperationLookup& find);

}  // namespace vesselbench
