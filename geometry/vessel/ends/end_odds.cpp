#include "geometry/vessel/ends/end_odds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/ends/end_weights.h"

namespace vesselbench {

namespace {

constexpr std::size_t kClasses = 3;

/// By feature and class: opening, sac, bump.
using Weights = std::array<std::array<double, kClasses>, kEndFeatures.size()>;

/// \throw AlgorithmFailure if the table has other features than the program
Weights weights_from(const std::string& table) {
    Weights weights{};
    std::istringstream lines(table);
    std::size_t row = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("feature,")) continue;
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (row >= weights.size() || name != kEndFeatures[row])
            throw AlgorithmFailure("end_weights.csv does not fit the features: '" + name + "'");
        for (double& weight : weights[row]) words >> weight;
        if (!words) throw AlgorithmFailure("end_weights.csv lacks weights of '" + name + "'");
        ++row;
    }
    if (row != weights.size()) throw AlgorithmFailure("end_weights.csv lacks features");
    return weights;
}

}  // namespace

EndOdds odds_of(const EndProfile& profile) {
    static const Weights weights = weights_from(end_weight_tables().at("end_weights.csv"));
    const EndFeatures features = features_of(profile);
    std::array<double, kClasses> score{};
    for (std::size_t f = 0; f < features.size(); ++f)
        for (std::size_t c = 0; c < kClasses; ++c) score[c] += weights[f][c] * features[f];
    const double most = *std::ranges::max_element(score);
    double sum = 0.0;
    for (double& s : score) sum += s = std::exp(s - most);
    return {score[0] / sum, score[1] / sum, score[2] / sum};
}

}  // namespace vesselbench
