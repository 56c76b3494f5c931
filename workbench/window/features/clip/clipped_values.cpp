#include "workbench/window/features/clip/clipped_values.h"

#include <cmath>
#include <cstddef>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kRounding = 1e-6;  ///< of the range, by which an end may be missed [-]

/// "3 %", "0.4 %"
std::string share_text(double share) {
    const double percent = 100.0 * share;
    if (percent < 0.1) return "less than 0.1 %";
    return formatted(percent, percent < 1.0 ? "%.1f %%" : "%.0f %%");
}

}  // namespace

ClippedShares clipped_shares(const std::vector<double>& values, const ValueRange& range) {
    const double little = kRounding * (range.most - range.least);
    std::size_t finite = 0, below = 0, above = 0;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        ++finite;
        if (value < range.least - little) ++below;
        if (value > range.most + little) ++above;
    }
    if (finite == 0) return {};
    const auto all = static_cast<double>(finite);
    return {static_cast<double>(below) / all, static_cast<double>(above) / all};
}

std::string clipped_words(const ClippedShares& shares) {
    std::string text;
    if (shares.above > 0.0) text = share_text(shares.above) + " above the range";
    if (shares.below > 0.0)
        text += text.empty() ? share_text(shares.below) + " below the range"
                             : ", " + share_text(shares.below) + " below it";
    return text;
}

ClippedShares ClippedCount::of(const Values& values, const ValueRange& range) {
    if (values == counted_ && range == range_) return shares_;
    counted_ = values;
    range_ = range;
    shares_ = values ? clipped_shares(*values, range) : ClippedShares{};
    return shares_;
}

}  // namespace vesselbench
