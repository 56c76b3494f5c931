#include "workbench/worker/run_operation.h"

namespace vesselbench {

Outcome run_operation(const Operation& operation, const Scene& scene, const Arguments& given,
                      Progress& progress, const WorkerOptions& worker) {
    const Arguments checked = checked_arguments(operation, given);
    progress.check_cancelled();
    Outcome outcome = operation.isolated
                          ? run_in_worker(operation, scene, checked, progress, worker)
                          : run_here(operation, scene, checked, progress);
    for (const auto& [name, value] : checked.values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    return outcome;
}

Outcome run_without_figures(const Operation& operation, const Scene& scene, const Arguments& given,
                            Progress& progress) {
    if (operation.start == nullptr) return run_operation(operation, scene, given, progress);
    const auto live = operation.start(scene, checked_arguments(operation, given), progress);
    Outcome outcome;
    outcome.scene = live->scene();
    outcome.resolved = live->resolved();
    return outcome;
}

}  // namespace vesselbench
