#include "geometry/vessel/ends/end_odds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vessel/ends/weight_table.h"

namespace vesselbench {

namespace {

constexpr std::size_t kClasses = 3;  // opening, sac, bump

}  // namespace

EndOdds odds_of(const EndProfile& profile) {
    static const auto weights = weights_from<kClasses>("end_weights.csv", kEndFeatures);
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
