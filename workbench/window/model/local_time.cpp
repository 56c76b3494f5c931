#include "workbench/window/model/local_time.h"

#include <ctime>

namespace vesselbench {

std::string local_time(const char* format) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char text[32];
    return {text, std::strftime(text, sizeof text, format, &local)};
}

}  // namespace vesselbench
