#include "geometry/kernel/deviation_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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
    std::vector<double> sizes;
    for (const double value : values)
        if (!std::isnan(value)) sizes.push_back(std::abs(value));
    if (sizes.empty()) return kLeastRange;
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(
                                        kShownShare * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, at);
    return std::max(*at, kLeastRange);
}

}  // namespace

DeviationMap deviation_map(const Surface& surface, const Surface& reference,
                           std::span<const std::uint8_t> compared, const Progress& progress) {
    const SurfaceDistance distance(reference);
    const std::span<const Vec3> points = surface.points();
    DeviationMap map;
    map.values.reserve(points.size());
    for (std::size_t first = 0; first < points.size(); first += kPointsAtOnce) {
        progress.check_cancelled();
        const auto part = points.subspan(first, std::min(kPointsAtOnce, points.size() - first));
        std::ranges::copy(distance.signed_distances(part), std::back_inserter(map.values));
    }
    for (std::size_t v = 0; v < compared.size(); ++v)
        if (!compared[v]) map.values[v] = std::numeric_limits<double>::quiet_NaN();
    map.full = range_of(map.values);
    return map;
}

}  // namespace vesselbench
