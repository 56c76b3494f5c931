#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

struct ClippedSurface {
    Surface surface;
    std::vector<FailedCut> failed;  ///< openings left out; empty: everything was done
};

/// Does what the plan says, and names the openings (name_openings).
/// \param graph for the removal of stubs; may be null if there are none
/// \throw AlgorithmFailure if a kept cap or a rim is not there
[[nodiscard]] ClippedSurface clip_openings(const Surface& surface, const OpeningPlan& plan,
                                           const InletChoice& inlet = {},
                                           const CenterlineGraph* graph = nullptr,
                                           const Progress& progress = {});

}  // namespace vesselbench
