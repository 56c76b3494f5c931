#pragma once

#include "geometry/vessel/openings/openings.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What was decided, and the surface made by it.
struct Clipping {
    OpeningPlan plan;
    Surface surface;
    OpeningPlanOptions options;  ///< with the places of ends that were named by their numbers
};

/// Plans and cuts as the arguments ask; where a cut fails, plans again without it.
/// \throw AlgorithmFailure if an end that has to be open cannot be, a vessel would be lost, or a
/// flow could not enter and leave; Cancelled
[[nodiscard]] Clipping decide_openings(const Scene& scene, const Arguments& arguments,
                                       const Progress& progress);

/// The ends and what would become of them, without cutting or checking anything.
/// \throw AlgorithmFailure if there is no end, or one that has to be open cannot be; Cancelled
[[nodiscard]] OpeningPlan planned_openings(const Scene& scene, const Arguments& arguments,
                                           const Progress& progress);

/// Makes the openings that an earlier run resolved: `planes`, `names` and `closings`.
/// \throw UsageError if these are incomplete; AlgorithmFailure if a cut fails; Cancelled
[[nodiscard]] Clipping repeat_openings(const Surface& surface, const Arguments& arguments,
                                       const Progress& progress);

}  // namespace vesselbench
