#pragma once

#include <vector>

#include "geometry/vessel/ends/end_choice.h"
#include "workbench/findings/reading.h"

namespace vesselbench {

/// What a short blind branch may be: a sac, a vessel or a stub, likeliest first, with what was
/// measured for each. \param verdict none: it was not judged
[[nodiscard]] std::vector<Reading> branch_readings(const std::optional<EndVerdict>& verdict);

}  // namespace vesselbench
