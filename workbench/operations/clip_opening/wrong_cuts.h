#pragma once

#include <vector>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// Ends are small parts of vessels. Centerlines of an organ lead through its lobes, and a cut
/// across one would leave the rest. \throw AlgorithmFailure if half of a closed surface would go
void require_most_kept(const Surface& before, const Surface& after);

/// Cuts that were made, but have opened a vessel's side or lost a vessel: places to be avoided.
/// \param vessels centerlines before, without frays, whose threads nobody misses
/// \throw AlgorithmFailure if a vessel is lost, but by none of the plan's cuts
[[nodiscard]] std::vector<FailedCut> wrong_cuts(const Surface& before,
                                                const CenterlineGraph& vessels,
                                                const OpeningPlan& plan, const Surface& after);

}  // namespace vesselbench
