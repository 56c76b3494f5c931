#pragma once

#include <numeric>
#include <vector>

namespace vesselbench {

/// Mean of values; 0 if there are none.
[[nodiscard]] inline double mean(const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace vesselbench
