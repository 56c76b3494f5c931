#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quality/search.h"

#include "workbench/suggest/search_subject.h"

namespace vesselbench {

/// Little, medium and strong smoothing (thesis 6.5.6).
constexpr std::array<double, 3> kPresetTaus = {0.3, 0.6, 1.0};

/// How parameter sets are gone through.
enum class SearchWay {
    Automatic,   ///< coarse, then refined; of four parameters or more: pattern
    Coarse,      ///< all coarse values
    Exhaustive,  ///< all values
    Pattern      ///< thesis 6.5.5
};

/// \throw UsageError unless "automatic", "coarse", "exhaustive" or "pattern"
[[nodiscard]] SearchWay search_way_from(const std::string& name);

/// Suggestions for one surface; what was measured serves for every target smoothness.
class SuggestionSearch {
public:
    /// \param planes measures the error as Eq. 6.2 prints it, too
    SuggestionSearch(const SearchSubject& subject, ScoreSettings settings, SearchWay way,
                     bool planes = false);

    /// \throw UsageError unless tau is in [0, 1]; Cancelled
    [[nodiscard]] Suggestion suggest(double tau, const Progress& progress = {});

    /// The coarse values of all parameters.
    [[nodiscard]] std::vector<ParameterSet> coarse_sets() const;

    [[nodiscard]] std::optional<QualityMeasures> measures(const ParameterSet& set,
                                                          const Progress& progress = {});

    [[nodiscard]] Surface smoothed(const ParameterSet& set, const Progress& progress = {}) const;

    [[nodiscard]] const SearchSpace& space() const { return search_.space(); }

    [[nodiscard]] const QualityMeasures& original() const { return chosen_.engine->original(); }

    [[nodiscard]] double mean_edge() const { return chosen_.engine->mean_edge(); }

    /// Who smooths and measures.
    [[nodiscard]] const ChosenEngine& chosen() const { return chosen_; }

    [[nodiscard]] QualityTable::Work work() const { return search_.work(); }

private:
    /// With many parameters, another tau is searched from what the last one found.
    [[nodiscard]] Suggestion from_pattern(const Progress& progress);

    const SearchSubject& subject_;
    SearchWay way_;
    ScoreSettings settings_;
    ChosenEngine chosen_;
    ParameterSearch search_;
    std::optional<Suggestion> last_;
};

}  // namespace vesselbench
