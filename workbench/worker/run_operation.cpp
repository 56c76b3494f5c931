#include "workbench/worker/run_operation.h"

namespace vesselbench {

namespace {

bool stays_here(const Operation& operation, const Arguments& arguments) {
    return operation.stays_here != nullptr && operation.stays_here(arguments);
}

/// Operations that could run in this process get the same time and memory in a worker.
WorkerOptions without_limits(WorkerOptions worker) {
    worker.memory_limit = 0;
    worker.time_limit = std::chrono::hours(24 * 365);
    return worker;
}

Outcome outcome_of(const Operation& operation, const Scene& scene,
                   const CheckedArguments& arguments, Progress& progress,
                   const WorkerOptions& worker) {
    if (operation.isolated) return run_in_worker(operation, scene, arguments, progress, worker);
    if (worker.every_operation && !stays_here(operation, arguments))
        return run_in_worker(operation, scene, arguments, progress, without_limits(worker));
    return run_here(operation, scene, arguments, progress);
}

}  // namespace

Outcome run_operation(const Operation& operation, const Scene& scene,
                      const CheckedArguments& arguments, Progress& progress,
                      const WorkerOptions& worker) {
    progress.check_cancelled();
    Outcome outcome = outcome_of(operation, scene, arguments, progress, worker);
    for (const auto& [name, value] : arguments->values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    return outcome;
}

Outcome run_without_figures(const Operation& operation, const Scene& scene,
                            const CheckedArguments& arguments, Progress progress) {
    if (operation.start == nullptr) return run_operation(operation, scene, arguments, progress);
    const auto live = operation.start(scene, arguments, progress);
    Outcome outcome;
    outcome.scene = live->scene();
    outcome.resolved = live->resolved();
    return outcome;
}

}  // namespace vesselbench
