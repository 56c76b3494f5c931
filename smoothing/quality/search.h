#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search_space.h"

namespace vesselbench {

/// Searches one surface's parameter sets for the lowest score (thesis 6.5.5). All results are kept
/// for the next search; sets that are left out count as infinitely bad. Of equal scores the
/// smallest value of the last parameter wins (in smoothing, the fewest iterations), then the
/// smallest of the others, so that "do not smooth" is 0, 0.
class ParameterSearch {
public:
    /// For smoothing.
    ParameterSearch(const std::shared_ptr<const SmoothingEngine>& engine, const SearchSpace& space,
                    ScoreSettings settings);

    /// For any operation.
    ParameterSearch(std::shared_ptr<MeasureSource> table, SearchSpace space,
                    ScoreSettings settings);

    /// All sets of the grid, or of its coarse values.
    [[nodiscard]] std::vector<ParameterSet> grid(bool coarse) const;

    /// The best of them. \throw Cancelled
    [[nodiscard]] Suggestion exhaustive(bool coarse, const Progress& progress = {});

    /// The first suggestion: the best coarse set; with four parameters or more, whose coarse grid
    /// takes too long, the result of a pattern search. On surfaces with enough vertices (20,000),
    /// both use estimates from a sample of them, and measure their result in full.
    /// \param last result of a search with many parameters and another score: the start of this one
    /// \throw Cancelled
    [[nodiscard]] Suggestion first_look(const std::optional<Suggestion>& last = {},
                                        const Progress& progress = {});

    /// The final suggestion: the first one, refined by single steps of the grid. \throw Cancelled
    [[nodiscard]] Suggestion settled(const Suggestion& first, const Progress& progress = {});

    /// Starts n times, each near the largest value of one of the n parameters and near the smallest
    /// of the others, and moves to the best set of the (3^n - 1)-neighbourhood until none is
    /// better. Initially the neighbourhood extends over `reach` twentieths of the parameters'
    /// ranges; at each minimum it is halved, down to single steps of the grid. From the best of
    /// these minima it is stretched along one parameter at a time: few strong iterations equal many
    /// weak ones, so good sets lie along a valley that single steps miss.
    /// \throw Cancelled
    [[nodiscard]] Suggestion pattern(int reach = 8, const Progress& progress = {});

    /// A pattern search from one set of the grid. \throw Cancelled
    [[nodiscard]] Suggestion refined(const Suggestion& from, int reach,
                                     const Progress& progress = {});

    /// The best value of one parameter while the others are fixed (6.5.5): the suggestion during
    /// dragging. \throw Cancelled
    [[nodiscard]] Suggestion along(std::size_t parameter, const ParameterSet& current,
                                   const Progress& progress = {});

    /// A search that measures by estimates only, where there are any, and shares them with this
    /// one.
    [[nodiscard]] ParameterSearch estimating() const {
        return {estimates_ ? estimates_ : table_, space_, settings_};
    }

    [[nodiscard]] const SearchSpace& space() const { return space_; }

    [[nodiscard]] MeasureSource& table() { return *table_; }

    /// The work done so far, estimates included.
    [[nodiscard]] MeasureSource::Work work() const;

    [[nodiscard]] const ScoreSettings& settings() const { return settings_; }

    /// Sets another target smoothness or score; all measurements of the surface are kept.
    void set_score(ScoreSettings settings) {
        settings_ = settings;
        settings_.volume_weight = space_.volume_weight;
    }

    /// The best of some sets. \throw InvalidInput if all of them are left out; Cancelled
    [[nodiscard]] Suggestion best_of(const std::vector<ParameterSet>& sets,
                                     const Progress& progress = {});

private:
    [[nodiscard]] bool has_small_grid() const;
    [[nodiscard]] Suggestion estimated_grid(const Progress& progress);
    [[nodiscard]] Suggestion estimated_pattern(const std::optional<Suggestion>& from,
                                               const Progress& progress);

    SearchSpace space_;
    ScoreSettings settings_;
    std::shared_ptr<MeasureSource> table_, estimates_;  ///< null: not worth it
};

}  // namespace vesselbench
