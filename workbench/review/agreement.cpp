#include "workbench/review/agreement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace vesselbench {

namespace {

/// Values by how often a unit has them.
std::map<std::string, double> counts_of(const RatedUnit& unit) {
    std::map<std::string, double> counts;
    for (const std::string& value : unit) counts[value] += 1.0;
    return counts;
}

double pairs_of(const std::map<std::string, double>& counts) {
    double pairs = 0.0;
    for (const auto& [value, count] : counts) pairs += count * (count - 1.0);
    return pairs;
}

std::vector<RatedUnit> pairable(const std::vector<RatedUnit>& units) {
    std::vector<RatedUnit> kept;
    std::ranges::copy_if(units, std::back_inserter(kept),
                         [](const RatedUnit& unit) { return unit.size() >= 2; });
    return kept;
}

/// \param share of the sorted values below it [-]
double percentile(const std::vector<double>& sorted, double share) {
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::lround(share * last))];
}

}  // namespace

std::optional<double> observed_agreement(const std::vector<RatedUnit>& units) {
    double equal = 0.0, all = 0.0;
    for (const RatedUnit& unit : pairable(units)) {
        const auto size = static_cast<double>(unit.size());
        equal += pairs_of(counts_of(unit));
        all += size * (size - 1.0);
    }
    return all > 0.0 ? std::optional(equal / all) : std::nullopt;
}

std::optional<double> krippendorff_alpha(const std::vector<RatedUnit>& units) {
    double n = 0.0, coincident = 0.0;
    std::map<std::string, double> totals;
    for (const RatedUnit& unit : pairable(units)) {
        const auto counts = counts_of(unit);
        const auto size = static_cast<double>(unit.size());
        coincident += pairs_of(counts) / (size - 1.0);
        n += size;
        for (const auto& [value, count] : counts) totals[value] += count;
    }
    const double by_chance = pairs_of(totals);
    if (n < 2.0 || n * (n - 1.0) - by_chance <= 0.0) return std::nullopt;
    return ((n - 1.0) * coincident - by_chance) / (n * (n - 1.0) - by_chance);
}

Agreement agreement_of(const std::vector<RatedUnit>& units, std::uint64_t seed) {
    constexpr std::size_t kDraws = 1000, kMostWithoutAlpha = kDraws / 20;
    const std::vector<RatedUnit> kept = pairable(units);
    Agreement made{.units = kept.size(), .share = observed_agreement(kept)};
    for (const RatedUnit& unit : kept) made.values += unit.size();
    if (kept.size() < kFewestUnits) return made;
    made.alpha = krippendorff_alpha(kept);
    std::mt19937_64 random(seed);
    std::vector<double> alphas;
    std::vector<RatedUnit> drawn(kept.size());
    for (std::size_t draw = 0; draw < kDraws; ++draw) {
        for (RatedUnit& unit : drawn) unit = kept[random() % kept.size()];
        if (const auto alpha = krippendorff_alpha(drawn)) alphas.push_back(*alpha);
    }
    if (!made.alpha || alphas.size() < kDraws - kMostWithoutAlpha) return made;
    std::ranges::sort(alphas);
    made.lower = percentile(alphas, 0.025);
    made.upper = percentile(alphas, 0.975);
    return made;
}

}  // namespace vesselbench
