#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Ends what would come of a filter that diverges, such as Taubin's with mu far below -lambda:
/// every iteration multiplies what is left of the surface's waves, until nothing that works on the
/// result ends.
/// \throw AlgorithmFailure if a vertex whose start is finite is not finite, or ten times as far
/// from the surface's centre as its farthest vertex was
void require_bounded(const Positions& start, const Positions& result);

/// How many times as far out a vertex may end [-].
inline constexpr double kMostGrowth = 10.0;

/// \throw AlgorithmFailure that says what helps
[[noreturn]] void report_divergence();

}  // namespace vesselbench
