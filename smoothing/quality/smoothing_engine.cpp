#include "smoothing/quality/smoothing_engine.h"

#include <cmath>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "smoothing/filters/divergence.h"

namespace vesselbench {

SharedWeights weights_of(const SmoothingChoice& choice) {
    if (!choice.staircase) return choice.weights;
    const auto& [tau_theta, tau_max, beta_min] = choice.staircase->values;
    return choice.staircase->on_cpu(tau_theta, tau_max, beta_min);
}

double radius_of(const Positions& points) {
    return 0.5 * bounds(points).diagonal();
}

bool is_bounded(const QualityMeasures& measures, double radius) {
    const double sum = measures.error + measures.error_thesis + measures.curvature +
                       measures.curvature_abs + measures.volume;
    return std::isfinite(sum) && measures.error <= kMostGrowth * radius;
}

void require_bounded(const QualityMeasures& measures, double radius) {
    if (!is_bounded(measures, radius)) report_divergence();
}

std::vector<QualityMeasures> MeasuredRun::measure_at(std::span<const int> iterations,
                                                     const Progress& progress) {
    std::vector<QualityMeasures> measures;
    for (const int wanted : iterations) {
        advance_to(wanted, progress);
        try {
            measures.push_back(measure());
        } catch (const AlgorithmFailure&) {
            break;
        }
    }
    return measures;
}

}  // namespace vesselbench
