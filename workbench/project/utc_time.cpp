#include "workbench/project/utc_time.h"

#include <array>
#include <ctime>

namespace vesselbench {

std::string utc_text(std::chrono::system_clock::time_point time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

std::string utc_now() {
    return utc_text(std::chrono::system_clock::now());
}

bool is_utc_time(const std::string& text) {
    std::tm parts{};
    // The library's reader takes February 30 for March 1: what is written again shows it.
    if (const char* end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
        end == nullptr || *end != '\0')
        return false;
    return utc_text(std::chrono::system_clock::from_time_t(timegm(&parts))) == text;
}

}  // namespace vesselbench
