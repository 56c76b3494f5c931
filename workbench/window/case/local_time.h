#pragma once

#include <string>

namespace vesselbench {

/// The time of the user's clock. \param format of strftime, for at most 31 characters
[[nodiscard]] std::string local_time(const char* format);

/// A time of a log, "2024-05-17T09:30:00Z", by the user's clock; another text as it is.
[[nodiscard]] std::string local_time(const std::string& utc, const char* format);

}  // namespace vesselbench
