#include "smoothing/quality/stepwise_analysis.h"

#include <algorithm>
#include <vector>

#include <tbb/task_arena.h>

namespace vesselbench {

namespace {

/// All sets of the graphs, those first that show most: the current one, then coarse values from the
/// largest on, which in most operations make the fewest triangles and take the least time.
std::vector<ParameterSet> graph_sets(const SearchSpace& space, const ParameterSet& current) {
    std::vector<ParameterSet> sets = {current};
    for (const bool coarse : {true, false})
        for (std::size_t i = 0; i < space.parameters.size(); ++i) {
            std::vector<double> values = chosen_values(space.parameters[i], coarse);
            std::ranges::reverse(values);
            for (const double value : values) {
                sets.push_back(current);
                sets.back()[i] = value;
            }
        }
    return sets;
}

void send_one_by_one(ParameterSearch& graphs, const ParameterSet& current,
                     const std::function<void(const StepwiseAnswer&)>& send,
                     const Progress& progress) {
    MeasureSource& table = graphs.table();
    bool first = true;
    for (const ParameterSet& set : graph_sets(graphs.space(), current)) {
        if (!first && table.knows(set)) continue;
        table.find({&set, 1}, progress);
        first = false;
        send({.analysis = sensitivity(graphs, current, CurveValues::Known, progress)});
    }
}

}  // namespace

void analyse_step_by_step(ParameterSearch& graphs, ParameterSearch& best,
                          const ParameterSet& current,
                          const std::function<void(const StepwiseAnswer&)>& send,
                          const Progress& progress) {
    StepwiseAnswer known;
    if (graphs.table().runs_each()) {
        send_one_by_one(graphs, current, send, progress);
    } else {
        known.analysis = sensitivity(graphs, current, CurveValues::Coarse, progress);
        send(known);
    }
    known.analysis = sensitivity(graphs, current, CurveValues::All, progress);
    send(known);
    known.best = best.first_look({}, progress);
    send(known);
    known.best = best.settled(*known.best, progress);
    known.complete = true;
    send(known);
}

void analyse_dragged(ParameterSearch& graphs, ParameterSearch& best, const ParameterSet& current,
                     const std::function<void(const StepwiseAnswer&)>& send,
                     const Progress& progress) {
    tbb::task_arena(1).execute([&] {
        ParameterSearch rough = graphs.estimating();
        static_cast<void>(sensitivity(rough, current, CurveValues::Coarse, progress));
        // What is known besides makes finer curves, for nothing.
        StepwiseAnswer known{.analysis = sensitivity(rough, current, CurveValues::Known, progress)};
        send(known);
        known.best = best.first_look({}, progress);
        send(known);
    });
}

}  // namespace vesselbench
