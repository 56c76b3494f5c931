#pragma once

#include "geometry/vessel/openings/plan_draft.h"

namespace vesselbench {

/// Finds the ends that the caller's `inlets` and `open` mean, and closes those of `closed`.
/// \throw AlgorithmFailure if no end lies near a point, or two inlets mean the same one
void decide_named_ends(PlanDraft& draft);

}  // namespace vesselbench
