#include "smoothing/laplace.h"

#include "smoothing/filter_support.h"
#include "smoothing/linear_filter.h"

namespace vesselbench {

Positions laplace(const Topology& topology, const Positions& positions,
                  const LaplaceParameters& parameters, const FilterSettings& settings,
                  const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    const detail::LinearStep step{.umbrella = parameters.lambda};
    return detail::run_linear_filter(topology, positions, {&step, 1}, settings, progress);
}

}  // namespace vesselbench
