#pragma once

#include <string>

namespace vesselbench {

/// The time of the user's clock. \param format of strftime, for at most 31 characters
[[nodiscard]] std::string local_time(const char* format);

}  // namespace vesselbench
