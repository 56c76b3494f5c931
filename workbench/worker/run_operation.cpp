#include "workbench/worker/run_operation.h"

namespace vesselbench {

namespace {

bool uses_gpu(const Arguments& checked) {
    return checked.optional_text("device") == "gpu";
}

/// Operations that could run in this process get the same time and memory in a worker.
WorkerOptions without_limits(WorkerOptions worker) {
    worker.memory_limit = 0;
    worker.time_limit = std::chrono::hours(24 * 365);
    return worker;
}

Outcome outcome_of(const Operation& operation, const Scene& scene, const Arguments& checked,
                   Progress& progress, const WorkerOptions& worker) {
    if (operation.isolated) return run_in_worker(operation, scene, checked, progress, worker);
    if (worker.every_operation && !uses_gpu(checked))
        return run_in_worker(operation, scene, checked, progress, without_limits(worker));
    return run_here(operation, scene, checked, progress);
}

}  // namespace

Outcome run_operation(const Operation& operation, const Scene& scene, const Arguments& given,
                      Progress& progress, const WorkerOptions& worker) {
    const Arguments checked = checked_arguments(operation, given);
    progress.check_cancelled();
    Outcome outcome = outcome_of(operation, scene, checked, progress, worker);
    for (const auto& [name, value] : checked.values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    return outcome;
}

Outcome run_without_figures(const Operation& operation, const Scene& scene, const Arguments& given,
                            Progress progress) {
    if (operation.start == nullptr) return run_operation(operation, scene, given, progress);
    const auto live = operation.start(scene, checked_arguments(operation, given), progress);
    Outcome outcome;
    outcome.scene = live->scene();
    outcome.resolved = live->resolved();
    return outcome;
}

}  // namespace vesselbench
