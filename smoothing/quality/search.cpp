#include "smoothing/quality/search.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "smoothing/quality/combinations.h"
#include "smoothing/quality/pattern_search.h"

namespace vesselbench {

ParameterSearch::ParameterSearch(const std::shared_ptr<const SmoothingEngine>& engine,
                                 const SearchSpace& space, ScoreSettings settings)
    : ParameterSearch(std::make_shared<QualityTable>(engine, space.chooser), space, settings) {
    if (engine->estimates())
        estimates_ = std::make_shared<QualityTable>(engine, space_.chooser, 0, Fidelity::Estimate);
}

bool ParameterSearch::has_small_grid() const {
    constexpr std::size_t kMostForGrid = 3;
    return space_.parameters.size() <= kMostForGrid;
}

ParameterSearch::ParameterSearch(std::shared_ptr<MeasureSource> table, SearchSpace space,
                                 ScoreSettings settings)
    : space_(std::move(space)), table_(std::move(table)) {
    set_score(settings);
    for (const SearchParameter& parameter : space_.parameters)
        if (parameter.values.empty())
            throw InvalidInput("there is no value to search for " + parameter.name);
}

Suggestion ParameterSearch::best_of(const std::vector<ParameterSet>& sets,
                                    const Progress& progress) {
    return vesselbench::best_of(*table_, sets, settings_, progress);
}

MeasureSource::Work ParameterSearch::work() const {
    const MeasureSource::Work& full = table_->work();
    if (!estimates_) return full;
    const MeasureSource::Work& rough = estimates_->work();
    return {full.evaluations + rough.evaluations, full.runs + rough.runs,
            full.sweeps + rough.sweeps};
}

Suggestion ParameterSearch::estimated_grid(const Progress& progress) {
    if (!estimates_) return exhaustive(true, progress);
    const Suggestion rough = vesselbench::best_of(*estimates_, grid(true), settings_, progress);
    return best_of({rough.values}, progress);
}

std::vector<ParameterSet> ParameterSearch::grid(bool coarse) const {
    std::vector<std::vector<double>> rows;
    for (const SearchParameter& parameter : space_.parameters)
        rows.push_back(chosen_values(parameter, coarse));
    return combinations(rows);
}

Suggestion ParameterSearch::exhaustive(bool coarse, const Progress& progress) {
    return best_of(grid(coarse), progress);
}

Suggestion ParameterSearch::pattern(int reach, const Progress& progress) {
    return PatternSearch(*table_, space_, settings_).from_starts(reach, progress);
}

Suggestion ParameterSearch::estimated_pattern(const std::optional<Suggestion>& from,
                                              const Progress& progress) {
    constexpr int kReach = 8;
    const PatternSearch search(estimates_ ? *estimates_ : *table_, space_, settings_);
    const Suggestion found =
        from ? search.from(from->values, kReach, progress) : search.from_starts(kReach, progress);
    return best_of({found.values}, progress);
}

Suggestion ParameterSearch::refined(const Suggestion& from, int reach, const Progress& progress) {
    return PatternSearch(*table_, space_, settings_).from(from.values, reach, progress);
}

Suggestion ParameterSearch::first_look(const std::optional<Suggestion>& last,
                                       const Progress& progress) {
    return has_small_grid() ? estimated_grid(progress) : estimated_pattern(last, progress);
}

Suggestion ParameterSearch::settled(const Suggestion& first, const Progress& progress) {
    constexpr int kReach = 2;
    return has_small_grid() ? refined(first, kReach, progress) : first;
}

Suggestion ParameterSearch::along(std::size_t parameter, const ParameterSet& current,
                                  const Progress& progress) {
    std::vector<ParameterSet> sets;
    for (const double value : space_.parameters.at(parameter).values) {
        sets.push_back(current);
        sets.back()[parameter] = value;
    }
    return best_of(sets, progress);
}

}  // namespace vesselbench
