#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// Findings of less certainty are not listed unless asked for [-]: they are more often wrong than
/// right.
inline constexpr double kListed = 0.5;

/// The same of a finding in a report; one that has no certainty is listed.
[[nodiscard]] bool is_listed_finding(const nlohmann::ordered_json& finding);

}  // namespace vesselbench
