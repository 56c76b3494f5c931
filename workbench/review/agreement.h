#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vesselbench {

/// The verdicts on one unit, an edit: one text a reviewer, in any order; reviewers who gave none
/// are left out. Units with fewer than two verdicts say nothing about agreement.
using RatedUnit = std::vector<std::string>;

/// Share of the pairs of verdicts on the same unit that are equal [-]; none: there is no pair.
[[nodiscard]] std::optional<double> observed_agreement(const std::vector<RatedUnit>& units);

/// Krippendorff's alpha for nominal data with missing values [-]: 1 is agreement, 0 what chance
/// gives, below 0 is disagreement.
/// Source: Krippendorff, "Computing Krippendorff's alpha-reliability", 2011.
/// \return none: there is no pair, or all verdicts are equal, so that nothing tells agreement from
/// chance
[[nodiscard]] std::optional<double> krippendorff_alpha(const std::vector<RatedUnit>& units);

/// Alpha with its 95 % interval.
struct Agreement {
    std::size_t units = 0;        ///< with at least two verdicts
    std::size_t values = 0;       ///< their verdicts
    std::optional<double> share;  ///< observed_agreement()
    std::optional<double> alpha;  ///< none also: fewer than kFewestUnits
    /// Percentiles of the bootstrap over units, which takes units as independent; none also: more
    /// than one draw in 20 has verdicts of one kind only, and no alpha.
    std::optional<double> lower, upper;
};

/// With fewer units, alpha depends on single verdicts.
constexpr std::size_t kFewestUnits = 30;

/// \param seed of the bootstrap, which draws the units with replacement 1,000 times
[[nodiscard]] Agreement agreement_of(const std::vector<RatedUnit>& units, std::uint64_t seed = 1);

}  // namespace vesselbench
