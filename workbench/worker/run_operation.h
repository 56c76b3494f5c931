#pragma once

#include "workbench/case/operation.h"
#include "workbench/worker/worker.h"

namespace vesselbench {

/// Runs an operation: checks the arguments, runs it here or, if it is `isolated`, in a worker
/// process. The one place where operations are called; nothing is caught.
/// \param given arguments as the user gave them; defaults are filled in
/// \return the outcome; its resolved arguments hold every checked argument as well
/// \throw UsageError if the arguments do not fit the operation; whatever the operation throws
[[nodiscard]] Outcome run_operation(const Operation& operation, const Scene& scene,
                                    const Arguments& given, Progress& progress,
                                    const WorkerOptions& worker = {});

/// The same scene and resolved arguments without a report: for searches, where the figures of an
/// operation with a live form cost as much again.
/// \throw as run_operation
[[nodiscard]] Outcome run_without_figures(const Operation& operation, const Scene& scene,
                                          const Arguments& given, Progress& progress);

}  // namespace vesselbench
