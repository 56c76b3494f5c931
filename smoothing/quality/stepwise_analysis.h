#pragma once

#include <functional>
#include <optional>

#include "smoothing/quality/sensitivity.h"

namespace vesselbench {

/// What is known of a set so far.
struct StepwiseAnswer {
    SensitivityAnalysis analysis;    ///< with a suggestion for each parameter
    std::optional<Suggestion> best;  ///< of all parameters together; none in the first answers
    bool complete = false;           ///< no finer answer follows
};

/// Sends answers for a set, coarse ones first: graphs, then finer ones, a first suggestion, and the
/// settled one. Where every set takes a run, the graphs are also sent with each value found.
/// What was measured before is not measured again; the complete answer does not depend
/// on it.
/// \param graphs search whose parameters are varied
/// \param best search of the best of all; it may be the same
/// \throw Cancelled
void analyse_step_by_step(ParameterSearch& graphs, ParameterSearch& best,
                          const ParameterSet& current,
                          const std::function<void(const StepwiseAnswer&)>& send,
                          const Progress& progress);

/// Sends rough answers while a value is dragged (thesis 6.5.5): a suggestion for each parameter
/// from coarse values, then one of all parameters together, both found by estimates where there are
/// any. None of them is complete. It occupies the calling thread only: whatever is dragged comes
/// first. \throw Cancelled
void analyse_dragged(ParameterSearch& graphs, ParameterSearch& best, const ParameterSet& current,
                     const std::function<void(const StepwiseAnswer&)>& send,
                     const Progress& progress);

}  // namespace vesselbench
