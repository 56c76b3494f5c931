#include "workbench/suggest/smoothing_search.h"

#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

ChosenEngine smoothing_engine(const SmoothingSubject& subject, bool planes) {
    return make_engine(subject.device, subject.ground, planes, offscreen_device,
                       subject.staircase_ground);
}

SearchSpace smoothing_space_for(const SmoothingSubject& subject, const SmoothingEngine& engine,
                                bool all_parameters) {
    return smoothing_space({.filter = subject.filter,
                            .weights = subject.weights,
                            .staircase = subject.staircase,
                            .engine_weighs = engine.weighs_staircases(),
                            .slice = subject.slice,
                            .all_parameters = all_parameters,
                            .mu_stays = subject.mu_stays});
}

ParameterSet smoothing_set(const SmoothingSubject& subject, const SearchSpace& space) {
    return current_set(space, subject.filter, subject.iterations, subject.thresholds);
}

Surface smoothed_with(const SmoothingSubject& subject, const Surface& surface,
                      const SearchSpace& space, const ParameterSet& set, const Progress& progress) {
    const auto choice = space.chooser(std::span(set.data(), set.size() - 1));
    if (!choice) throw InvalidInput("these parameters would roughen the surface");
    FilterRun run(FilterRun::prepare(subject.ground), choice->filter, weights_of(*choice));
    run.advance(static_cast<int>(set.back()), progress);
    Positions moved;
    run.write_positions(moved);
    return surface.with_positions(std::move(moved));
}

}  // namespace vesselbench
