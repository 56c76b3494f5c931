#include "smoothing/filters/divergence.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "geometry/kernel/errors.h"

namespace vesselbench {

void require_bounded(const Positions& start, const Positions& result) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : start)
        if (p.allFinite()) box.extend(p);
    if (box.isEmpty()) return;
    const Vec3 centre = box.center();
    double radius = 0.0;
    for (const Vec3& p : start)
        if (p.allFinite()) radius = std::max(radius, (p - centre).norm());
    for (std::size_t v = 0; v < start.size(); ++v) {
        if (!start[v].allFinite() || (result[v] - centre).norm() <= kMostGrowth * radius) continue;
        report_divergence();
    }
}

void report_divergence() {
    throw AlgorithmFailure(
        "the filter diverges: its vertices leave the surface further with every iteration; "
        "take smaller steps (lambda, mu closer to -lambda) or fewer iterations");
}

}  // namespace vesselbench
