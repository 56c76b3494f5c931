#include "smoothing/laplace_hc.h"

#include <array>

#include "smoothing/filter_support.h"
#include "smoothing/linear_filter.h"

namespace vesselbench {

Positions laplace_hc(const Topology& topology, const Positions& positions,
                     const LaplaceHcParameters& parameters, const FilterSettings& settings,
                     const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    detail::require_range("alpha", parameters.alpha, 0.0, 1.0);
    detail::require_range("beta", parameters.beta, 0.0, 1.0);
    using detail::LinearStep;
    const double alpha = parameters.alpha;
    // (3.3), (3.4): b = v* - alpha o - (1 - alpha) v = lambda U + alpha (v - o)
    const LinearStep difference{.onto = LinearStep::Onto::Zero,
                                .umbrella = parameters.lambda,
                                .source = alpha,
                                .start = -alpha};
    // (3.5), (3.6): v* + d - v with v* = v + b + alpha (o - v), and the mean of the b as b + U
    const LinearStep correction{.onto = LinearStep::Onto::Target,
                                .umbrella = parameters.beta - 1.0,
                                .target = -alpha,
                                .start = alpha};
    return detail::run_linear_filter(topology, positions, std::array{difference, correction},
                                     settings, progress);
}

bool amplifies(const LaplaceHcParameters& parameters) {
    const double highest = 2.0;
    return (1.0 - parameters.beta) * parameters.lambda * highest * highest > 2.0;
}

}  // namespace vesselbench
