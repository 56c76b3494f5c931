#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search.h"
#include "workbench/suggest/search_subject.h"

namespace vesselbench {

/// Little, medium and strong smoothing (thesis 6.5.6).
constexpr std::array<double, 3> kPresetTaus = {0.3, 0.6, 1.0};

/// How parameter sets are searched.
enum class SearchWay {
    Automatic,   ///< coarse, then refined; of four parameters or more: pattern
    Coarse,      ///< all coarse values
    Exhaustive,  ///< all values
    Pattern      ///< thesis 6.5.5
};

/// \throw UsageError unless "automatic", "coarse", "exhaustive" or "pattern"
[[nodiscard]] SearchWay search_way_from(const std::string& name);

/// Suggestions for one surface; its measurements serve every target smoothness.
class SuggestionSearch {
public:
    /// \param planes also measures the error as printed in Eq. 6.2
    SuggestionSearch(const SearchSubject& subject, ScoreForm form, SearchWay way,
                     bool planes = false);

    /// \throw UsageError unless tau is in [0, 1]; Cancelled
    [[nodiscard]] Suggestion suggest(double tau, const Progress& progress = {});

    /// The coarse values of all parameters.
    [[nodiscard]] std::vector<ParameterSet> coarse_sets() const;

    [[nodiscard]] std::optional<QualityMeasures> measures(const ParameterSet& set,
                                                          const Progress& progress = {});

    /// The operation's result on the surface.
    [[nodiscard]] Surface changed(const ParameterSet& set, const Progress& progress = {}) const;

    [[nodiscard]] const SearchSpace& space() const { return search_.space(); }

    [[nodiscard]] const QualityMeasures& original() { return search_.table().original(); }

    [[nodiscard]] double mean_edge() { return search_.table().mean_edge(); }  ///< [mm]

    [[nodiscard]] ScoreForm form() const { return search_.settings().form; }

    /// The device that smooths and measures; for other operations the CPU.
    [[nodiscard]] const ChosenEngine& chosen() const { return chosen_; }

    [[nodiscard]] MeasureSource::Work work() const { return search_.work(); }

private:
    const SearchSubject& subject_;
    SearchWay way_;
    ChosenEngine chosen_;
    ParameterSearch search_;
    std::optional<Suggestion> last_;  ///< with many parameters: the start for another tau
};

}  // namespace vesselbench
