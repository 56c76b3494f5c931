#include "workbench/commands/console/progress_line.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kSoonest = 5.0;     ///< after the begin [s]
constexpr double kFewest = 0.1;      ///< of the work
constexpr double kSpeechless = 1.0;  ///< less than this is not worth saying [s]
constexpr std::size_t kBar = 24;     ///< [columns]

/// As far as it is known: 43 s is "40 s".
std::string rounded_text(double seconds) {
    const double unit = std::pow(10.0, std::floor(std::log10(seconds)));
    const double rounded = std::round(seconds / unit) * unit;
    return rounded < 10.0 ? formatted(rounded, "%.0f s") : duration_text(rounded);
}

}  // namespace

std::optional<double> remaining_time(double fraction, double elapsed) {
    if (elapsed < kSoonest || fraction < kFewest) return std::nullopt;
    return elapsed * (1.0 - fraction) / fraction;
}

std::string progress_text(double fraction, std::string_view what, double elapsed) {
    std::string text = formatted(100.0 * fraction, "%3.0f %%  ") + printable(what);
    if (const auto left = remaining_time(fraction, elapsed); left && *left > kSpeechless)
        text += ", about " + rounded_text(*left) + " left";
    return text;
}

std::string progress_bar(double fraction, std::string_view what, double elapsed,
                         std::size_t width) {
    const double share = std::clamp(fraction, 0.0, 1.0);
    const auto done = static_cast<std::size_t>(share * static_cast<double>(kBar));
    return shortened("[" + std::string(done, '#') + std::string(kBar - done, '.') + "] " +
                         progress_text(share, what, elapsed),
                     width);
}

}  // namespace vesselbench
