#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/quality_table.h"
#include "smoothing/quality/score.h"

namespace vesselbench {

/// A parameter that a search may change.
struct SearchParameter {
    std::string name;            ///< as the operation calls it
    std::string unit;            ///< "-", "mm"; empty: a number of things
    std::vector<double> values;  ///< ascending
    int coarse = 1;              ///< the first look takes every so many-th value, and the last
    std::optional<double> idle = std::nullopt;  ///< with which nothing changes, whatever the others
};

/// All values, or the coarse ones.
[[nodiscard]] std::vector<double> chosen_values(const SearchParameter& parameter, bool coarse);

/// What a search goes through: the grid of all values. Smoothing has the iterations last.
struct SearchSpace {
    std::vector<SearchParameter> parameters;
    Chooser chooser;  ///< of smoothing only
};

/// True if a set leaves the surface as it is.
[[nodiscard]] bool does_nothing(const SearchSpace& space, const ParameterSet& set);

/// A parameter set and how good it is.
struct Suggestion {
    ParameterSet values;
    QualityMeasures measures;
    ScoreTerms terms;
    double score = 0.0;
};

/// Searches one surface's parameter sets for the lowest score (thesis 6.5.5). Everything found is
/// kept for the next search; sets that are left out count as infinitely bad. Of equal scores the
/// smallest value of the last parameter wins (of smoothing, the fewest iterations), then the
/// smallest of the others, so that "do not smooth" is 0, 0.
class ParameterSearch {
public:
    /// Of smoothing.
    ParameterSearch(const std::shared_ptr<const SmoothingEngine>& engine, const SearchSpace& space,
                    ScoreSettings settings);

    /// Of any operation.
    ParameterSearch(std::shared_ptr<MeasureSource> table, SearchSpace space,
                    ScoreSettings settings);

    /// All sets of the grid, or of its coarse values.
    [[nodiscard]] std::vector<ParameterSet> grid(bool coarse) const;

    /// The best of them. \throw Cancelled
    [[nodiscard]] Suggestion exhaustive(bool coarse, const Progress& progress = {});

    /// What to suggest, at first: the best coarse set; of four parameters or more, whose coarse
    /// grid takes too long, what a pattern search finds. Where the surface has enough vertices for
    /// that (20,000), both look at estimates from a sample of them, and measure what they find in
    /// full. \param last of a search of many parameters with another score: where this one begins
    /// \throw Cancelled
    [[nodiscard]] Suggestion first_look(const std::optional<Suggestion>& last = {},
                                        const Progress& progress = {});

    /// What to suggest in the end: that, with the grid's single steps. \throw Cancelled
    [[nodiscard]] Suggestion settled(const Suggestion& first, const Progress& progress = {});

    /// From n starts, each near the largest value of one of the n parameters and near the smallest
    /// of the others, to the best set of the (3^n - 1)-neighbourhood until none is better. At first
    /// the neighbourhood reaches `reach` twentieths of the parameters' ranges; at each minimum it
    /// is halved, down to single steps of the grid. From the best of these minima on it is
    /// stretched along one parameter at a time: strong and few iterations give about the same as
    /// weak and many, so that good sets lie along a valley, which single steps do not follow.
    /// \throw Cancelled
    [[nodiscard]] Suggestion pattern(int reach = 8, const Progress& progress = {});

    /// A pattern search from one set of the grid. \throw Cancelled
    [[nodiscard]] Suggestion refined(const Suggestion& from, int reach,
                                     const Progress& progress = {});

    /// The best value of one parameter while the others stay (6.5.5): the suggestion while it is
    /// dragged. \throw Cancelled
    [[nodiscard]] Suggestion along(std::size_t parameter, const ParameterSet& current,
                                   const Progress& progress = {});

    [[nodiscard]] const SearchSpace& space() const { return space_; }

    [[nodiscard]] MeasureSource& table() { return *table_; }

    /// What was done so far, estimates included.
    [[nodiscard]] MeasureSource::Work work() const;

    [[nodiscard]] const ScoreSettings& settings() const { return settings_; }

    /// Another target smoothness or score; what is known of the surface stays known.
    void set_score(ScoreSettings settings) { settings_ = settings; }

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
