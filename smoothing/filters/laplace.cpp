#include "smoothing/filters/laplace.h"

#include "smoothing/filters/linear_filter.h"
#include "smoothing/filters/linear_steps.h"

namespace vesselbench {

Positions laplace(const Topology& topology, const Positions& positions,
                  const LaplaceParameters& parameters, const FilterSettings& settings,
                  const Progress& progress) {
    return run_linear_filter(topology, positions, linear_steps(parameters), settings, progress);
}

}  // namespace vesselbench
