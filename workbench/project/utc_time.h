#pragma once

#include <string>

namespace vesselbench {

/// The time now, "2024-05-17T09:30:00Z".
[[nodiscard]] std::string utc_now();

}  // namespace vesselbench
