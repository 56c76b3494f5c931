#include "smoothing/quality/smoothing_engine.h"

namespace vesselbench {

SharedWeights weights_of(const SmoothingChoice& choice) {
    if (!choice.staircase) return choice.weights;
    const auto& [tau_theta, tau_max, beta_min] = choice.staircase->values;
    return choice.staircase->on_cpu(tau_theta, tau_max, beta_min);
}

}  // namespace vesselbench
