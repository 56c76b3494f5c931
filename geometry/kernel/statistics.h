#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace vesselbench {

/// Mean of values, added up in their order; 0 if there are none.
[[nodiscard]] inline double mean(std::span<const double> values) {
    if (values.empty()) return 0.0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The value in the middle, of an even number the upper of the two; 0 if there are none.
template <class Number>
[[nodiscard]] double median(std::vector<Number> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
}

/// The value below which a share of the others lie, without interpolation. Reorders the values.
/// \param values not empty \param share from 0 to 1
template <class Number>
[[nodiscard]] double percentile(std::vector<Number>& values, double share) {
    const auto at =
        values.begin() +
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

/// The value below which a share of the weight lies, without interpolation.
/// \param values not empty \param weights #values, at least 0 \param share from 0 to 1
[[nodiscard]] inline double weighted_percentile(std::span<const double> values,
                                                std::span<const double> weights, double share) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    const double wanted = share * std::accumulate(weights.begin(), weights.end(), 0.0);
    double below = 0.0;
    for (const std::size_t i : order)
        if ((below += weights[i]) >= wanted) return values[i];
    return values[order.back()];  // the sums differ by rounding
}

}  // namespace vesselbench
