#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/ends/end_weights.h"

namespace vesselbench {

/// The weights of a model by feature and class, from a table that scripts/fit_ends.py wrote: a row
/// a feature, comments behind #.
/// \throw AlgorithmFailure if the table has other features than the program
template <std::size_t Classes, std::size_t Features>
[[nodiscard]] std::array<std::array<double, Classes>, Features> weights_from(
    const std::string& name, const std::array<std::string_view, Features>& features) {
    std::array<std::array<double, Classes>, Features> weights{};
    std::istringstream lines(std::string(end_weight_tables().at(name)));
    std::size_t row = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("feature,")) continue;
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        std::string feature;
        words >> feature;
        if (row >= Features || feature != features[row])
            throw AlgorithmFailure(name + " does not fit the features: '" + feature + "'");
        for (double& weight : weights[row]) words >> weight;
        if (!words) throw AlgorithmFailure(name + " lacks weights of '" + feature + "'");
        ++row;
    }
    if (row != Features) throw AlgorithmFailure(name + " lacks features");
    return weights;
}

}  // namespace vesselbench
