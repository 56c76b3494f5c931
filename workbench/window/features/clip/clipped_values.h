#pragma once

#include <memory>
#include <string>
#include <vector>

#include "workbench/colours/colourings.h"

namespace vesselbench {

/// How many of the finite values are outside the range of their colours, in [0, 1] [-].
struct ClippedShares {
    double below = 0.0, above = 0.0;

    bool operator==(const ClippedShares&) const = default;
};

[[nodiscard]] ClippedShares clipped_shares(const std::vector<double>& values,
                                           const ValueRange& range);

/// "3 % above the range, 0.4 % below it"; empty: all are inside.
[[nodiscard]] std::string clipped_words(const ClippedShares& shares);

/// Counts once as long as values and range stay the same.
class ClippedCount {
public:
    using Values = std::shared_ptr<const std::vector<double>>;

    /// \param values null: none
    [[nodiscard]] ClippedShares of(const Values& values, const ValueRange& range);

private:
    Values counted_;
    ValueRange range_;
    ClippedShares shares_;
};

}  // namespace vesselbench
