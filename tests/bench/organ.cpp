#include "tests/bench/organ.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/image/flying_edges.h"

namespace vesselbench::bench {

namespace {

const Vec3 kHalfAxes(60.0, 48.0, 39.0);  // [mm]
constexpr double kLobes = 0.06;          // height of the lobes by the half-axes [-]

/// Approximate depth below the wall [mm]; negative outside.
double depth(const Vec3& p) {
    const Vec3 q = p.cwiseQuotient(kHalfAxes);
    const double lobes =
        std::sin(5.0 * q.x()) * std::cos(4.0 * q.y()) + std::sin(6.0 * q.z() + 1.0) * q.x();
    return (1.0 + kLobes * lobes - q.norm()) * kHalfAxes.z();
}

/// The grey value of a voxel that contains a part of the organ: 16 levels, never on the wall.
float grey(double cells_deep) {
    return static_cast<float>((std::floor(8.0 * std::clamp(cells_deep, -1.0, 0.999)) + 0.5) / 8.0);
}

}  // namespace

Surface organ(double vertices, int slice) {
    constexpr double kVerticesByArea = 1.5;  // marching cubes, per cell face: E(|nx| + |ny| + |nz|)
    constexpr double kArea = 31000.0;        // [mm^2]
    GridFrame grid{.spacing = std::sqrt(kVerticesByArea * kArea / vertices)};
    const Vec3 reach = (1.0 + 2.5 * kLobes) * kHalfAxes;
    grid.origin = -reach;
    for (int a = 0; a < 3; ++a)
        grid.size[static_cast<std::size_t>(a)] =
            static_cast<int>(std::ceil(2.0 * reach[a] / grid.spacing)) + 1;
    const auto [ni, nj, nk] = grid.size;
    std::vector<float> values(static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj) *
                              static_cast<std::size_t>(nk));
    tbb::parallel_for(0, nk, [&, ni = ni, nj = nj](int k) {
        auto at = static_cast<std::size_t>(k) * static_cast<std::size_t>(ni) *
                  static_cast<std::size_t>(nj);
        const double z = k / slice * slice + 0.5 * (slice - 1);
        for (int j = 0; j < nj; ++j)
            for (int i = 0; i < ni; ++i)
                values[at++] =
                    grey(depth(grid.origin + grid.spacing * Vec3(i, j, z)) / grid.spacing);
    });
    GridSurface found = flying_edges(values, grid);
    Positions points;
    points.reserve(found.points.size());
    for (const auto& [x, y, z] : found.points) points.emplace_back(x, y, z);
    return make_surface(std::move(points), std::move(found.triangles));
}

}  // namespace vesselbench::bench
