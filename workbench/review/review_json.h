#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/review/review.h"

namespace vesselbench {

/// A list of {"reviewer", "role", "time", "verdict", "comment", "revision", "outdated"}.
[[nodiscard]] nlohmann::ordered_json verdicts_json(const std::vector<GivenVerdict>& verdicts);

/// A review as JSON: every edit of the current state with its verdicts.
[[nodiscard]] nlohmann::ordered_json review_json(const Review& review);

}  // namespace vesselbench
