#include "smoothing/filters/linear_steps.h"

#include <cmath>
#include <sstream>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

void require_parameters(const TaubinParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    const double mu = parameters.used_mu();
    if (mu <= -parameters.lambda && std::isfinite(mu)) return;
    std::ostringstream text;
    text << "mu = " << mu << " must be at most -lambda = " << -parameters.lambda
         << " (mu is negative: it undoes the shrinking of lambda)";
    throw InvalidInput(text.str());
}

}  // namespace

std::vector<LinearStep> linear_steps(const LaplaceParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    return {{.umbrella = parameters.lambda}};
}

std::vector<LinearStep> linear_steps(const LaplaceHcParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    require_range("alpha", parameters.alpha, 0.0, 1.0);
    require_range("beta", parameters.beta, 0.0, 1.0);
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
    return {difference, correction};
}

std::vector<LinearStep> linear_steps(const TaubinParameters& parameters) {
    require_parameters(parameters);
    const LinearStep shrink{.umbrella = parameters.lambda};  // (3.7)
    // (3.8): s + mu U; the weights scale it relative to t, the position before the pair (5.1)
    const LinearStep inflate{.onto = LinearStep::Onto::Target,
                             .umbrella = parameters.used_mu(),
                             .source = 1.0,
                             .target = -1.0};
    return {shrink, inflate};
}

}  // namespace vesselbench
