#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/quality_table.h"
#include "smoothing/quality/score.h"

namespace vesselbench {

/// A parameter that a search may change.
struct SearchParameter {
    std::string name;            ///< the operation's name for it
    std::string unit;            ///< "-", "mm"; empty: a count
    std::vector<double> values;  ///< ascending
    int coarse = 1;              ///< the first pass uses every n-th value, and the last
    std::optional<double> idle = std::nullopt;  ///< value without any effect
};

/// All values, or the coarse ones.
[[nodiscard]] std::vector<double> chosen_values(const SearchParameter& parameter, bool coarse);

/// The space of a search: the grid of all values. In smoothing the iterations are last.
struct SearchSpace {
    std::vector<SearchParameter> parameters;
    Chooser chooser;                       ///< for smoothing only
    double volume_weight = kVolumeWeight;  ///< of the score [-]
};

/// True if a set leaves the surface as it is.
[[nodiscard]] bool does_nothing(const SearchSpace& space, const ParameterSet& set);

/// A parameter set and its score.
struct Suggestion {
    ParameterSet values;
    QualityMeasures measures;
    ScoreTerms terms;
    double score = 0.0;
};

}  // namespace vesselbench
