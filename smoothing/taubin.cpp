#include "smoothing/taubin.h"

#include <array>
#include <cmath>
#include <sstream>

#include "geometry/errors.h"
#include "smoothing/filter_support.h"
#include "smoothing/linear_filter.h"

namespace vesselbench {

namespace {

void require_parameters(const TaubinParameters& parameters) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    const double mu = parameters.used_mu();
    if (mu <= -parameters.lambda && std::isfinite(mu)) return;
    std::ostringstream text;
    text << "mu = " << mu << " must be at most -lambda = " << -parameters.lambda
         << " (mu is negative: it undoes the shrinking of lambda)";
    throw InvalidInput(text.str());
}

}  // namespace

Positions taubin(const Topology& topology, const Positions& positions,
                 const TaubinParameters& parameters, const FilterSettings& settings,
                 const Progress& progress) {
    require_parameters(parameters);
    using detail::LinearStep;
    const LinearStep shrink{.umbrella = parameters.lambda};  // (3.7)
    // (3.8): s + mu U, which the weights bring in relation to the position before, t (5.1)
    const LinearStep inflate{.onto = LinearStep::Onto::Target,
                             .umbrella = parameters.used_mu(),
                             .source = 1.0,
                             .target = -1.0};
    return detail::run_linear_filter(topology, positions, std::array{shrink, inflate}, settings,
                                     progress);
}

bool amplifies(const TaubinParameters& parameters) {
    const double highest = 2.0;
    return std::abs((1.0 - parameters.lambda * highest) * (1.0 - parameters.used_mu() * highest)) >
           1.0;
}

}  // namespace vesselbench
