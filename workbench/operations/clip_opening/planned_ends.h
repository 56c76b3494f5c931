#pragma once

#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// The ends as people read them: by their numbers, those without one last.
[[nodiscard]] std::vector<EndRecord> ends_by_number(const OpeningPlan& plan);

/// Names of the plan's openings: only the inlets are known before they are made.
[[nodiscard]] std::vector<std::string> planned_names(const OpeningPlan& plan);

}  // namespace vesselbench
