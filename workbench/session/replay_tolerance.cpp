#include "workbench/session/replay_tolerance.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/measure.h"

namespace vesselbench {

std::optional<ReplayDistance> replay_distance(const Surface& stored, const Surface& replayed) {
    constexpr double kNearlyAll = 0.999, kUsual = 1e-5, kLargest = 5e-4;
    if (stored.vertex_count() != replayed.vertex_count()) return std::nullopt;
    std::vector<double> distances(stored.vertex_count());
    for (std::size_t v = 0; v < distances.size(); ++v)
        distances[v] = (stored.points()[v] - replayed.points()[v]).norm();
    if (distances.empty()) return ReplayDistance{0.0, true};
    std::ranges::sort(distances);
    const double diagonal = bounds(stored).diagonal();
    const auto nearly_all =
        static_cast<std::size_t>(kNearlyAll * static_cast<double>(distances.size() - 1));
    return ReplayDistance{distances.back(), distances[nearly_all] <= kUsual * diagonal &&
                                                distances.back() <= kLargest * diagonal};
}

}  // namespace vesselbench
