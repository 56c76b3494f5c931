#include "workbench/session/guarded_run.h"

#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/session/overreach.h"

namespace vesselbench {

namespace {

constexpr double kCheckShare = 0.3;  ///< of the progress; measuring the change has the rest

}  // namespace

std::optional<Diagnostic> overreach_of(const Operation& operation, const Scene& input,
                                       const Outcome& outcome, const Progress& progress) {
    if (operation.may_change == nullptr) return std::nullopt;
    auto found = overreach(operation.may_change(input, outcome), input, outcome.scene, progress);
    if (found && found->operation.empty()) found->operation = operation.name;
    return found;
}

EditRun guarded_run(const Operation& operation, Scene input, Outcome outcome, double duration,
                    const Progress& progress, const std::function<bool()>& repeats) {
    auto found = overreach_of(operation, input, outcome, progress.part(0.0, kCheckShare));
    if (found && !(repeats && repeats())) throw DiagnosedFailure(std::move(*found));
    EditRun run = edit_run(operation, std::move(input), std::move(outcome), duration,
                           progress.part(kCheckShare, 1.0));
    if (found) {
        found->severity = Severity::Warning;
        run.record.warnings.push_back(std::move(*found));
    }
    return run;
}

}  // namespace vesselbench
