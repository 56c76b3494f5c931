#include "workbench/findings/finding.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Coordinates of an id are rounded [mm].
constexpr double kRounding = 0.002;

struct ParsedId {
    std::string_view kind;
    Vec3 place = Vec3::Zero();
};

std::optional<ParsedId> parsed(std::string_view id) {
    const std::size_t at = id.find('@');
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    ParsedId found{.kind = id.substr(0, at)};
    std::string_view rest = id.substr(at + 1);
    for (int k = 0; k < 3; ++k) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        if (k < 2) {
            if (!rest.starts_with(',')) return std::nullopt;
            rest.remove_prefix(1);
        }
        found.place[k] = value;
    }
    return rest.empty() ? std::optional(found) : std::nullopt;
}

}  // namespace

std::string Finding::id() const {
    return kind + "@" + coordinates_argument(place);
}

const Remedy* Finding::treatment() const {
    return evidence.remedies.empty() ? nullptr : &evidence.remedies.front();
}

const Finding* finding_of_id(std::span<const Finding> findings, const std::string& id) {
    const auto wanted = parsed(id);
    if (!wanted)
        throw UsageError("'" + shortened(printable(id)) +
                         "' is no finding: give its id as listed, such as bump@12.3,4.5,6.7");
    const Finding* nearest = nullptr;
    for (const Finding& finding : findings) {
        const double distance = (finding.place - wanted->place).norm();
        if (finding.kind != wanted->kind || distance > 0.5 * finding.size + kRounding) continue;
        if (nearest == nullptr || distance < (nearest->place - wanted->place).norm())
            nearest = &finding;
    }
    return nearest;
}

double certainty_of(double measured, double even, double sure) {
    constexpr double kMargin = 0.02;
    const double steepness = std::log(4.0) / (sure - even);  // 4 : 1 is 0.8
    const double odds = std::exp(-steepness * (measured - even));
    return std::clamp(1.0 / (1.0 + odds), kMargin, 1.0 - kMargin);
}

}  // namespace vesselbench
