#pragma once

#include <span>

#include "geometry/progress.h"
#include "geometry/topology.h"
#include "smoothing/filter_settings.h"
#include "smoothing/linear_step.h"

namespace vesselbench::detail {

/// Runs a filter whose iterations are one or two linear steps. The first step of an iteration reads
/// positions and writes them, or what the second needs; the second one's target are the positions
/// before the first. The last step's share is the weights, whose vertices the constraint keeps in
/// their cells; an earlier step's is 0 at fixed vertices, else 1.
/// \return moved positions in the order of `positions`
/// \throw InvalidInput if the settings do not fit the topology
[[nodiscard]] Positions run_linear_filter(const Topology& topology, const Positions& positions,
                                          std::span<const LinearStep> steps,
                                          const FilterSettings& settings, const Progress& progress);

}  // namespace vesselbench::detail
