#pragma once

#include "workbench/case/operation.h"
#include "workbench/worker/worker.h"

namespace vesselbench {

/// Runs an operation, here or, if it is `isolated`, in a worker process. The only place where
/// operations are called; nothing is caught.
/// \return the outcome; its resolved arguments also contain every given argument
/// \throw whatever the operation throws
[[nodiscard]] Outcome run_operation(const Operation& operation, const Scene& scene,
                                    const CheckedArguments& arguments, Progress& progress,
                                    const WorkerOptions& worker = {});

/// The same scene and resolved arguments alone: for searches, because the figures of an operation
/// with a live form would double the time.
/// \throw as run_operation
[[nodiscard]] Outcome run_without_figures(const Operation& operation, const Scene& scene,
                                          const CheckedArguments& arguments, Progress progress);

}  // namespace vesselbench
