#include "workbench/worker/run_operation.h"

namespace vesselbench {

Outcome run_operation(const Operation& operation, const Scene& scene, const Arguments& given,
                      Progress& progress, const WorkerOptions& worker) {
    const Arguments checked = checked_arguments(operation, given);
    progress.check_cancelled();
    Outcome outcome = operation.isolated
                          ? run_in_worker(operation, scene, checked, progress, worker)
                          : operation.run(scene, checked, progress);
    for (const auto& [name, value] : checked.values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    return outcome;
}

}  // namespace vesselbench
