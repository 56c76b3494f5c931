#include "workbench/findings/finding.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Coordinates of an id are rounded [mm].
constexpr double kRounding = 0.002;

std::optional<FindingId> parsed(std::string_view id) {
    const std::size_t at = id.find('@');
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    FindingId found{.kind = std::string(id.substr(0, at))};
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

double FindingId::distance(const std::string& of_kind, const Vec3& from, double size) const {
    const double away = (from - place).norm();
    return of_kind == kind && away <= 0.5 * size + kRounding
               ? away
               : std::numeric_limits<double>::infinity();
}

std::size_t listed_count(std::span<const Finding> findings) {
    const auto folded = std::ranges::find_if(
        findings, [](const Finding& finding) { return finding.certainty < kListed; });
    return static_cast<std::size_t>(folded - findings.begin());
}

FindingId finding_id_from(const std::string& id) {
    auto found = parsed(id);
    if (!found)
        throw UsageError("'" + shortened(printable(id)) +
                         "' is no finding: give its id as listed, such as bump@12.3,4.5,6.7");
    return *std::move(found);
}

const Finding* finding_of_id(std::span<const Finding> findings, const std::string& id) {
    const FindingId wanted = finding_id_from(id);
    const Finding* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Finding& finding : findings) {
        const double distance = wanted.distance(finding.kind, finding.place, finding.size);
        if (distance >= least) continue;
        least = distance;
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
