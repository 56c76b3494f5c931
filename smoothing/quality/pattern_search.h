#pragma once

#include <vector>

#include "smoothing/quality/search_space.h"

namespace vesselbench {

/// The best of some sets. \throw InvalidInput if all of them are left out; Cancelled
[[nodiscard]] Suggestion best_of(MeasureSource& table, const std::vector<ParameterSet>& sets,
                                 const ScoreSettings& settings, const Progress& progress);

/// The pattern search (thesis 6.5.5): moves to the best set of the (3^n - 1)-neighbourhood until
/// none is better.
class PatternSearch {
public:
    PatternSearch(MeasureSource& table, const SearchSpace& space, const ScoreSettings& settings)
        : table_(table), space_(space), settings_(settings) {}

    /// As ParameterSearch::pattern.
    [[nodiscard]] Suggestion from_starts(int reach, const Progress& progress) const;

    /// As ParameterSearch::refined.
    [[nodiscard]] Suggestion from(const ParameterSet& start, int reach,
                                  const Progress& progress) const;

private:
    using Place = std::vector<int>;  ///< indices into the parameters' values

    [[nodiscard]] ParameterSet values_at(const Place& place) const;
    [[nodiscard]] Place place_of(const ParameterSet& values) const;
    [[nodiscard]] std::vector<ParameterSet> neighbourhood(const Place& centre,
                                                          const std::vector<int>& reach) const;
    void walk(Suggestion& best, const std::vector<int>& steps, const Progress& progress) const;
    [[nodiscard]] Suggestion descend(const Place& start, int reach, const Progress& progress) const;
    [[nodiscard]] Suggestion along_valley(Suggestion best, const Progress& progress) const;

    MeasureSource& table_;
    const SearchSpace& space_;
    ScoreSettings settings_;
};

}  // namespace vesselbench
