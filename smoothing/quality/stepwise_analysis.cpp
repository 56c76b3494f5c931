#include "smoothing/quality/stepwise_analysis.h"

namespace vesselbench {

void analyse_step_by_step(ParameterSearch& graphs, ParameterSearch& best,
                          const ParameterSet& current,
                          const std::function<void(const StepwiseAnswer&)>& send,
                          const Progress& progress) {
    StepwiseAnswer known{.analysis = sensitivity(graphs, current, true, progress)};
    send(known);
    known.analysis = sensitivity(graphs, current, false, progress);
    send(known);
    known.best = best.first_look({}, progress);
    send(known);
    known.best = best.settled(*known.best, progress);
    known.complete = true;
    send(known);
}

}  // namespace vesselbench
