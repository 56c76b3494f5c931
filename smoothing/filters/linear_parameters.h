#pragma once

#include <optional>

namespace vesselbench {

/// Parameters of the Laplace filter (thesis Eq. 3.1).
struct LaplaceParameters {
    double lambda = 0.5;  ///< step [-], 0 <= lambda <= 1
};

/// Parameters of the Laplace+HC filter. The thesis's tables and Chapter 6 call alpha and beta
/// "lambda" and "mu".
struct LaplaceHcParameters {
    double lambda = 0.5;  ///< Laplacian step [-], 0 <= lambda <= 1 (Eq. 3.3)
    double alpha = 0.0;   ///< 1: pull to the original position, 0: to the previous one [-]
    double beta = 0.5;    ///< weight of the vertex's own back-correction [-], in [0, 1]
};

/// Parameters of Taubin's lambda|mu filter, transfer function f(k) = (1 - lambda k)(1 - mu k) for
/// the umbrella operator's eigenvalues -k, 0 <= k <= 2.
struct TaubinParameters {
    double lambda = 0.5;            ///< shrinking step [-], 0 <= lambda <= 1
    std::optional<double> mu = {};  ///< inflating step [-], <= -lambda; default -1.02 lambda

    [[nodiscard]] double used_mu() const { return mu.value_or(-1.02 * lambda); }
};

}  // namespace vesselbench
