#include "workbench/suggest/live_processing_search.h"

#include <algorithm>
#include <utility>

#include "workbench/suggest/dragged_values.h"
#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

namespace {

SearchParameter* find(SearchSpace& space, const std::string& name) {
    const auto at = std::ranges::find(space.parameters, name, &SearchParameter::name);
    return at == space.parameters.end() ? nullptr : &*at;
}

class LiveProcessingSearch final : public LiveSearchWay {
public:
    LiveProcessingSearch(const Operation& operation, Scene scene)
        : operation_(operation), scene_(std::move(scene)) {}

    void answer(const Arguments& given, double tau, const Receiver& receive,
                const Progress& progress) override;

    void answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                        const Progress& progress) override;

private:
    void prepare(const Arguments& given);
    void take_spaces();
    void take_fixed(const Arguments& given);
    [[nodiscard]] const ParameterSet& set_of(const Arguments& given, const Progress& progress);
    [[nodiscard]] SearchSpace best_space(const ParameterSet& now);
    [[nodiscard]] LiveSearchAnswer answer_of(const StepwiseAnswer& found,
                                             const SearchSpace& searched) const;

    const Operation& operation_;
    Scene scene_;
    SearchSpace all_;       ///< of the graphs
    SearchSpace searched_;  ///< of the best of all: some of those parameters
    Arguments fixed_;       ///< given, and not searched
    std::shared_ptr<MeasureSource> table_;
    Arguments known_;  ///< given ones whose set is known
    ParameterSet set_;
};

/// Both need the surface alone.
void LiveProcessingSearch::take_spaces() {
    if (!all_.parameters.empty()) return;
    const Surface& surface = surface_of(scene_);
    searched_ = processing_space(operation_, surface, {}, false);
    all_ = processing_space(operation_, surface, {}, true);
}

/// Measures stay known while only searched parameters change.
void LiveProcessingSearch::take_fixed(const Arguments& given) {
    Arguments fixed = given;
    for (const SearchParameter& parameter : all_.parameters) fixed.remove(parameter.name);
    if (table_ && fixed_ == fixed) return;
    SearchSpace space = all_;
    for (SearchParameter& parameter : space.parameters)
        if (const SearchParameter* searched = find(searched_, parameter.name))
            parameter.idle = searched->idle;
    set_.clear();
    table_ = processing_table(operation_, scene_, checked_arguments(operation_, fixed), space);
    fixed_ = std::move(fixed);
}

const ParameterSet& LiveProcessingSearch::set_of(const Arguments& given, const Progress& progress) {
    if (!set_.empty() && known_ == given) return set_;
    set_.clear();
    set_ = processing_set(operation_, scene_, checked_arguments(operation_, given), all_, progress);
    known_ = given;
    return set_;
}

/// In the terms of the graphs, so that both use the same measures.
SearchSpace LiveProcessingSearch::best_space(const ParameterSet& now) {
    SearchSpace space = all_;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (const SearchParameter* searched = find(searched_, space.parameters[i].name))
            space.parameters[i] = *searched;
        else
            space.parameters[i].values = {now[i]};
    return space;
}

LiveSearchAnswer LiveProcessingSearch::answer_of(const StepwiseAnswer& found,
                                                 const SearchSpace& space) const {
    LiveSearchAnswer out{.analysis = found.analysis, .filter = "", .complete = found.complete};
    if (!found.best) return out;
    Arguments all;
    set_values(all, operation_, space, found.best->values);
    out.best.emplace();
    for (const SearchParameter& parameter : searched_.parameters)
        out.best->set(parameter.name, all.values().at(parameter.name));
    out.leave_as_is = does_nothing(space, found.best->values);
    return out;
}

void LiveProcessingSearch::prepare(const Arguments& given) {
    check_rivals(operation_, given);
    take_spaces();
    take_fixed(given);
}

void LiveProcessingSearch::answer(const Arguments& given, double tau, const Receiver& receive,
                                  const Progress& progress) {
    prepare(given);
    const ParameterSet& now = set_of(given, progress);
    const ScoreSettings score{.form = usual_score_of(operation_), .tau = tau};
    ParameterSearch graphs(table_, all_, score), best(table_, best_space(now), score);
    analyse_step_by_step(
        graphs, best, now,
        [&](const StepwiseAnswer& found) { receive(answer_of(found, best.space())); }, progress);
}

void LiveProcessingSearch::answer_dragged(const Arguments& given, double tau,
                                          const Receiver& receive, const Progress& progress) {
    prepare(given);
    // Each value takes a run: the coarse ones are all that can be had.
    const ParameterSet& now = set_of(with_nearest_values(operation_, given, all_, true), progress);
    const ScoreSettings score{.form = usual_score_of(operation_), .tau = tau};
    ParameterSearch graphs(table_, all_, score), best(table_, best_space(now), score);
    const auto send = [&](const StepwiseAnswer& found) {
        LiveSearchAnswer out = answer_of(found, best.space());
        set_current_values(out.analysis, given);
        receive(out);
    };
    analyse_dragged(graphs, best, now, send, progress);
}

}  // namespace

std::unique_ptr<LiveSearchWay> live_processing_search(const Operation& operation, Scene scene) {
    return std::make_unique<LiveProcessingSearch>(operation, std::move(scene));
}

}  // namespace vesselbench
