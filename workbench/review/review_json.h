#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/review/review.h"

namespace vesselbench {

/// {"state", "signer", "problem"}; the state is "none", "unverified", "verified" or "invalid".
[[nodiscard]] nlohmann::ordered_json signature_json(const Signature& signature);

/// A list of {"reviewer", "role", "time", "verdict", "comment", "revision", "outdated",
/// "signature"}.
[[nodiscard]] nlohmann::ordered_json verdicts_json(const std::vector<GivenVerdict>& verdicts);

/// A review as JSON: every edit of the current state with its verdicts.
[[nodiscard]] nlohmann::ordered_json review_json(const Review& review);

}  // namespace vesselbench
