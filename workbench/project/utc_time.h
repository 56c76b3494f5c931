#pragma once

#include <chrono>
#include <string>

namespace vesselbench {

/// "2024-05-17T09:30:00Z": earlier times are smaller texts.
[[nodiscard]] std::string utc_text(std::chrono::system_clock::time_point time);

/// The time now.
[[nodiscard]] std::string utc_now();

/// True of a text as utc_text() writes it whose day and time exist.
[[nodiscard]] bool is_utc_time(const std::string& text);

}  // namespace vesselbench
