#include "geometry/kernel/amounts.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/kernel/wording.h"

namespace vesselbench {

std::string duration_text(double seconds) {
    constexpr double kMinute = 60.0, kHour = 3600.0;
    if (seconds < 9.95) return formatted(seconds, "%.1f s");
    if (seconds < 2.0 * kMinute) return formatted(seconds, "%.0f s");
    if (seconds < 2.0 * kHour) return formatted(seconds / kMinute, "%.0f min");
    return formatted(seconds / kHour, "%.1f h");
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array kUnits = {" B", " KiB", " MiB", " GiB", " TiB"};
    constexpr double kStep = 1024.0;
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; size >= kStep && unit + 1 < kUnits.size(); ++unit) size /= kStep;
    return formatted(size, unit > 0 && size < 9.95 ? "%.2g" : "%.0f") + kUnits[unit];
}

std::string mebibytes_text(double mebibytes) {
    return size_text(static_cast<std::uint64_t>(std::ldexp(mebibytes, 20)));
}

}  // namespace vesselbench
