#include "smoothing/filters/laplace_hc.h"

#include "smoothing/filters/linear_filter.h"
#include "smoothing/filters/linear_steps.h"

namespace vesselbench {

Positions laplace_hc(const Topology& topology, const Positions& positions,
                     const LaplaceHcParameters& parameters, const FilterSettings& settings,
                     const Progress& progress) {
    return run_linear_filter(topology, positions, linear_steps(parameters), settings, progress);
}

bool amplifies(const LaplaceHcParameters& parameters) {
    const double highest = 2.0;
    return (1.0 - parameters.beta) * parameters.lambda * highest * highest > 2.0;
}

}  // namespace vesselbench
