#include "smoothing/filters/taubin.h"

#include <cmath>

#include "smoothing/filters/linear_filter.h"
#include "smoothing/filters/linear_steps.h"

namespace vesselbench {

Positions taubin(const Topology& topology, const Positions& positions,
                 const TaubinParameters& parameters, const FilterSettings& settings,
                 const Progress& progress) {
    return run_linear_filter(topology, positions, linear_steps(parameters), settings, progress);
}

bool amplifies(const TaubinParameters& parameters) {
    const double highest = 2.0;
    return std::abs((1.0 - parameters.lambda * highest) * (1.0 - parameters.used_mu() * highest)) >
           1.0;
}

}  // namespace vesselbench
