#include "geometry/kernel/deviation_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

/// Fraction of the vertices whose deviation is within the colours' range [-].
constexpr double kShownShare = 0.98;

/// Between two looks at whether it was cancelled; enough for all cores.
constexpr std::size_t kPointsAtOnce = 16384;

/// The least range [mm]: smaller deviations are rounding errors.
constexpr double kLeastRange = 1e-6;

double range_of(const std::vector<double>& values) {
    if (values.empty()) return kLeastRange;
    std::vector<double> sizes(values.size());
    std::ranges::transform(values, sizes.begin(), [](double value) { return std::abs(value); });
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(
                                        kShownShare * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, at);
    return std::max(*at, kLeastRange);
}

}  // namespace

DeviationMap deviation_map(const Surface& surface, const Surface& reference,
                           const Progress& progress) {
    const SurfaceDistance distance(reference);
    const std::span<const Vec3> points = surface.points();
    DeviationMap map;
    map.values.reserve(points.size());
    for (std::size_t first = 0; first < points.size(); first += kPointsAtOnce) {
        progress.check_cancelled();
        const auto part = points.subspan(first, std::min(kPointsAtOnce, points.size() - first));
        std::ranges::copy(distance.signed_distances(part), std::back_inserter(map.values));
    }
    map.full = range_of(map.values);
    return map;
}

}  // namespace vesselbench
