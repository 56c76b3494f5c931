#pragma once

#include <functional>

#include "workbench/session/edit_run.h"

namespace vesselbench {

/// The outcome of an operation as the record of a result, as edit_run() makes it, if it changes no
/// more of the surface than the operation states: the one place that all new results pass, whoever
/// asked for them.
/// \param repeats asked only of an outcome that changes more: true for an edit that ran on the same
/// input before. It keeps its bits and gets a warning. Null: it is a new one
/// \throw DiagnosedFailure if it changes more; Cancelled
[[nodiscard]] EditRun guarded_run(const Operation& operation, Scene input, Outcome outcome,
                                  double duration, const Progress& progress,
                                  const std::function<bool()>& repeats = {});

/// In what a stored edit that runs again changes more than its operation states; none: in nothing.
[[nodiscard]] std::optional<Diagnostic> overreach_of(const Operation& operation, const Scene& input,
                                                     const Outcome& outcome,
                                                     const Progress& progress);

}  // namespace vesselbench
