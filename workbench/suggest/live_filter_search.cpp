#include "workbench/suggest/live_filter_search.h"

#include <array>
#include <utility>
#include <vector>

#include "workbench/operations/smooth/filter_choice.h"
#include "workbench/suggest/dragged_values.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/suggest/search_subject.h"
#include "workbench/suggest/smoothing_search.h"

namespace vesselbench {

namespace {

/// The parameters of smoothing_space.
constexpr std::array kSearched = {"iterations", "lambda",    "mu",      "alpha",
                                  "beta",       "tau_theta", "tau_max", "beta_min"};

Arguments without_searched(Arguments arguments) {
    for (const char* name : kSearched) arguments.remove(name);
    return arguments;
}

Arguments values_of(const Operation& operation, const SearchSpace& space, const ParameterSet& set) {
    Arguments values;
    set_values(values, operation, space, set);
    return values;
}

/// Graphs go on beyond what is searched for suggestions of all parameters, in longer steps.
SearchSpace with_more_iterations(SearchSpace space) {
    constexpr double kMost = 100.0, kStep = 5.0;
    std::vector<double>& iterations = space.parameters.back().values;
    while (iterations.back() + kStep <= kMost) iterations.push_back(iterations.back() + kStep);
    return space;
}

class LiveFilterSearch final : public LiveSearchWay {
public:
    LiveFilterSearch(const Operation& operation, Scene scene)
        : operation_(operation), scene_(std::move(scene)) {}

    void answer(const Arguments& given, double tau, const Receiver& receive,
                const Progress& progress) override;

    void answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                        const Progress& progress) override;

private:
    void take_subject(const Arguments& given);
    [[nodiscard]] SmoothingSubject subject_of(const Arguments& given, Arguments& arguments) const;
    void take_best(const SmoothingSubject& now, const Arguments& arguments, ScoreSettings score);
    [[nodiscard]] ParameterSet prepare(const Arguments& given, double tau,
                                       const Progress& progress);
    [[nodiscard]] LiveSearchAnswer answer_of(const StepwiseAnswer& found) const;

    const Operation& operation_;
    Scene scene_;
    std::optional<SearchSubject> subject_;  ///< at the defaults of the searched parameters
    ChosenEngine chosen_;
    std::optional<ParameterSearch> graphs_, best_;
    Arguments best_for_;  ///< what best_ does not search
    std::string filter_;  ///< of the last question
};

/// Finds caps, staircases and distances again only if other arguments than the searched ones
/// change.
void LiveFilterSearch::take_subject(const Arguments& given) {
    const Arguments fixed = without_searched(given);
    if (subject_ && subject_->given == fixed) return;
    graphs_.reset();
    best_.reset();
    subject_.reset();
    SearchSubject subject{.operation = &operation_, .scene = scene_, .given = fixed};
    subject.arguments = checked_arguments(operation_, fixed);
    subject.smoothing = operation_.search.smoothing(scene_, fixed, subject.arguments);
    chosen_ = engine_for(subject);
    graphs_.emplace(
        search_for(subject, chosen_, with_more_iterations(space_for(subject, chosen_, true)), {}));
    subject_ = std::move(subject);
}

/// The subject at the given values.
SmoothingSubject LiveFilterSearch::subject_of(const Arguments& given, Arguments& arguments) const {
    arguments = subject_->arguments;
    arguments.remove("mu");
    for (const char* name : kSearched)
        if (const auto at = given.values().find(name); at != given.values().end())
            arguments.set(name, at->second);
    resolve_filter(scene_, arguments);
    SmoothingSubject now = *subject_->smoothing;
    now.filter = filter_from(arguments);
    now.iterations = static_cast<int>(arguments.integer("iterations"));
    now.mu_stays = given.has("mu");
    if (!now.staircase) return now;
    now.thresholds = {.tau_theta = arguments.real("tau_theta"),
                      .tau_max = arguments.real("tau_max"),
                      .beta_min = arguments.real("beta_min")};
    now.weights =
        now.staircase(now.thresholds.tau_theta, now.thresholds.tau_max, now.thresholds.beta_min);
    return now;
}

void LiveFilterSearch::take_best(const SmoothingSubject& now, const Arguments& arguments,
                                 ScoreSettings score) {
    const SearchSpace space = smoothing_space_for(now, *chosen_.engine, false);
    Arguments others = arguments;
    for (const SearchParameter& parameter : space.parameters) others.remove(parameter.name);
    if (!now.mu_stays) others.remove("mu");
    if (best_ && best_for_ == others) return best_->set_score(score);
    best_.emplace(chosen_.engine, space, score);
    best_for_ = std::move(others);
}

/// \return the set of the given values
ParameterSet LiveFilterSearch::prepare(const Arguments& given, double tau,
                                       const Progress& progress) {
    const ScoreSettings score{.tau = tau};
    Arguments arguments;
    const SmoothingSubject now = subject_of(given, arguments);
    filter_ = arguments.text(operation_.search.filter_parameter);
    progress.check_cancelled();
    take_best(now, arguments, score);
    graphs_->set_score(score);
    return smoothing_set(now, graphs_->space());
}

LiveSearchAnswer LiveFilterSearch::answer_of(const StepwiseAnswer& found) const {
    LiveSearchAnswer out{.analysis = found.analysis, .filter = filter_, .complete = found.complete};
    if (found.best) out.best = values_of(operation_, best_->space(), found.best->values);
    return out;
}

void LiveFilterSearch::answer(const Arguments& given, double tau, const Receiver& receive,
                              const Progress& progress) {
    take_subject(given);
    const ParameterSet now = prepare(given, tau, progress);
    analyse_step_by_step(
        *graphs_, *best_, now, [&](const StepwiseAnswer& found) { receive(answer_of(found)); },
        progress);
}

void LiveFilterSearch::answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                                      const Progress& progress) {
    take_subject(given);
    const ParameterSet now =
        prepare(with_nearest_values(operation_, given, graphs_->space(), false), tau, progress);
    const auto send = [&](const StepwiseAnswer& found) {
        LiveSearchAnswer out = answer_of(found);
        set_current_values(out.analysis, given);
        receive(out);
    };
    analyse_dragged(*graphs_, *best_, now, send, progress);
}

}  // namespace

std::unique_ptr<LiveSearchWay> live_filter_search(const Operation& operation, Scene scene) {
    return std::make_unique<LiveFilterSearch>(operation, std::move(scene));
}

}  // namespace vesselbench
