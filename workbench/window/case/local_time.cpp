#include "workbench/window/case/local_time.h"

#include <ctime>

namespace vesselbench {

namespace {

std::string by_user_clock(std::time_t time, const char* format) {
    std::tm local{};
    localtime_r(&time, &local);
    char text[32];
    return {text, std::strftime(text, sizeof text, format, &local)};
}

}  // namespace

std::string local_time(const char* format) {
    return by_user_clock(std::time(nullptr), format);
}

std::string local_time(const std::string& utc, const char* format) {
    std::tm parts{};
    if (strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) == nullptr) return utc;
    return by_user_clock(timegm(&parts), format);
}

}  // namespace vesselbench
