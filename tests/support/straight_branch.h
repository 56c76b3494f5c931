#pragma once

#include <functional>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench::test {

/// A straight branch of a graph in 100 steps.
/// \param radius by the share of its length, from 0 to 1 [mm]
[[nodiscard]] inline CenterlineBranch straight_branch(std::size_t from, std::size_t to,
                                                      const Vec3& a, const Vec3& b,
                                                      const std::function<double(double)>& radius) {
    CenterlineBranch branch{from, to, {}, {}};
    for (int i = 0; i <= 100; ++i) {
        branch.points.push_back(a + (b - a) * (i / 100.0));
        branch.radii.push_back(radius(i / 100.0));
    }
    return branch;
}

/// The same of one radius [mm].
[[nodiscard]] inline CenterlineBranch straight_branch(std::size_t from, std::size_t to,
                                                      const Vec3& a, const Vec3& b, double radius) {
    return straight_branch(from, to, a, b, [&](double) { return radius; });
}

}  // namespace vesselbench::test
