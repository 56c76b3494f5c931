#pragma once

#include "workbench/case/operation.h"
#include "workbench/worker/worker.h"

namespace vesselbench {

/// Runs an operation: checks the arguments, runs it here or, if it is `isolated`, in a worker
/// process. The only place where operations are called; nothing is caught.
/// \param given arguments given by the user; defaults are filled in
/// \return the outcome; its resolved arguments also contain every checked argument
/// \throw UsageError if the arguments do not fit the operation; whatever the operation throws
[[nodiscard]] Outcome run_operation(const Operation& operation, const Scene& scene,
                                    const Arguments& given, Progress& progress,
                                    const WorkerOptions& worker = {});

/// The same scene and resolved arguments without a report: for searches, because the figures of an
/// operation with a live form would double the time.
/// \throw as run_operation
[[nodiscard]] Outcome run_without_figures(const Operation& operation, const Scene& scene,
                                          const Arguments& given, Progress progress);

}  // namespace vesselbench
