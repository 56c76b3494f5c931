#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/kernel/statistics.h"

namespace vesselbench {

/// Deviations beyond so many standard deviations have no weight in a robust fit that is 95 % as
/// efficient as least squares where errors are normal [-].
/// Source: Beaton & Tukey, "The fitting of power series, meaning polynomials, illustrated on
/// band-spectroscopic data", Technometrics 16, 1974.
inline constexpr double kTukeyReach = 4.685;

/// The standard deviation over the median absolute deviation, of a normal distribution [-].
inline constexpr double kNormalScatter = 1.4826;

/// Weight of a deviation in a robust fit, Tukey's biweight: 1 at 0, 0 from the reach on.
/// \param reach > 0
[[nodiscard]] inline double biweight(double deviation, double reach) {
    const double u = deviation / reach;
    return std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
}

/// Median of the absolute values; 0 for none.
[[nodiscard]] inline double median_deviation(std::vector<double> deviations) {
    for (double& deviation : deviations) deviation = std::abs(deviation);
    return median(std::move(deviations));
}

/// Robust standard deviation by the median of absolute deviations.
/// \param deviations of any sign; 0 for none
[[nodiscard]] inline double scatter_of(std::vector<double> deviations) {
    return kNormalScatter * median_deviation(std::move(deviations));
}

}  // namespace vesselbench
