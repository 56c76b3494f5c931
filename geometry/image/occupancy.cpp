#include "geometry/image/occupancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr int kSubdivision = 4;  ///< along each axis of a voxel

/// The values of a voxel and its neighbours; those beyond the border repeat it.
using Around = std::array<float, 27>;

Around values_around(const Image& grid, const std::vector<float>& field, int i, int j, int k) {
    Around around;
    std::size_t n = 0;
    for (int dk = -1; dk <= 1; ++dk)
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di)
                around[n++] = field[grid.offset(std::clamp(i + di, 0, grid.size[0] - 1),
                                                std::clamp(j + dj, 0, grid.size[1] - 1),
                                                std::clamp(k + dk, 0, grid.size[2] - 1))];
    return around;
}

/// Linear interpolation of three neighbours at an offset in (-0.5, 0.5) from the middle one.
float between(float before, float middle, float after, float offset) {
    return offset < 0.0f ? middle + offset * (middle - before) : middle + offset * (after - middle);
}

float share_above(const Around& around) {
    int above = 0;
    for (int sk = 0; sk < kSubdivision; ++sk) {
        const auto offset = [](int s) {
            return (static_cast<float>(s) + 0.5f) / static_cast<float>(kSubdivision) - 0.5f;
        };
        std::array<float, 9> plane{};
        for (std::size_t n = 0; n < 9; ++n)
            plane[n] = between(around[n], around[n + 9], around[n + 18], offset(sk));
        for (int sj = 0; sj < kSubdivision; ++sj) {
            std::array<float, 3> row{};
            for (std::size_t n = 0; n < 3; ++n)
                row[n] = between(plane[n], plane[n + 3], plane[n + 6], offset(sj));
            for (int si = 0; si < kSubdivision; ++si)
                above += between(row[0], row[1], row[2], offset(si)) >= 0.0f ? 1 : 0;
        }
    }
    return static_cast<float>(above) /
           static_cast<float>(kSubdivision * kSubdivision * kSubdivision);
}

/// The voxel or one that has a face in common with it is marked.
bool is_beside(const Image& grid, const std::vector<std::uint8_t>& marked, int i, int j, int k) {
    const std::size_t v = grid.offset(i, j, k);
    const auto row = static_cast<std::size_t>(grid.size[0]),
               slice = row * static_cast<std::size_t>(grid.size[1]);
    return marked[v] != 0 || (i > 0 && marked[v - 1] != 0) ||
           (i + 1 < grid.size[0] && marked[v + 1] != 0) || (j > 0 && marked[v - row] != 0) ||
           (j + 1 < grid.size[1] && marked[v + row] != 0) || (k > 0 && marked[v - slice] != 0) ||
           (k + 1 < grid.size[2] && marked[v + slice] != 0);
}

/// Central differences [1/mm].
Vec3 gradient(const Image& grid, const std::vector<float>& field, const std::array<int, 3>& at,
              const Vec3& spacing) {
    Vec3 result;
    for (std::size_t a = 0; a < 3; ++a) {
        std::array<int, 3> before = at, after = at;
        before[a] = std::max(at[a] - 1, 0);
        after[a] = std::min(at[a] + 1, grid.size[a] - 1);
        const auto axis = static_cast<Eigen::Index>(a);
        result[axis] = (field[grid.offset(after[0], after[1], after[2])] -
                        field[grid.offset(before[0], before[1], before[2])]) /
                       (std::max(1, after[a] - before[a]) * spacing[axis]);
    }
    return result;
}

void add_crossings(const Image& grid, const std::vector<float>& field, const Vec3& spacing, int k,
                   std::vector<WallCrossing>& found) {
    for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i) {
            const std::array<int, 3> at = {i, j, k};
            const std::size_t from = grid.offset(i, j, k);
            for (std::size_t a = 0; a < 3; ++a) {
                std::array<int, 3> next = at;
                if (++next[a] >= grid.size[a]) continue;
                const std::size_t to = grid.offset(next[0], next[1], next[2]);
                if ((field[from] >= 0.0f) == (field[to] >= 0.0f)) continue;
                const float share = field[from] / (field[from] - field[to]);
                const Vec3 slope = (1.0 - share) * gradient(grid, field, at, spacing) +
                                   share * gradient(grid, field, next, spacing);
                const auto axis = static_cast<Eigen::Index>(a);
                const double size = slope.norm();
                const double facing = size > 0.0 ? std::abs(slope[axis]) / size : 0.0;
                found.push_back(
                    {.from = from,
                     .to = to,
                     .share = share,
                     .area = static_cast<float>(facing * spacing.prod() / spacing[axis])});
            }
        }
}

}  // namespace

std::vector<WallCrossing> wall_crossings(const Image& grid, const std::vector<float>& field) {
    const Vec3 spacing = grid.spacing();
    std::vector<std::vector<WallCrossing>> slices(static_cast<std::size_t>(grid.size[2]));
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        add_crossings(grid, field, spacing, k, slices[static_cast<std::size_t>(k)]);
    });
    std::vector<WallCrossing> all;
    for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
    return all;
}

std::vector<float> occupancy(const Image& grid, const std::vector<float>& field,
                             const std::vector<WallCrossing>& crossings) {
    std::vector<float> shares(field.size());
    for_each_vertex(field.size(),
                    [&](std::size_t v) { shares[v] = field[v] >= 0.0f ? 1.0f : 0.0f; });
    std::vector<std::uint8_t> mixed(field.size(), 0);
    for (const WallCrossing& c : crossings) mixed[c.from] = mixed[c.to] = 1;
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i)
                if (is_beside(grid, mixed, i, j, k))
                    shares[grid.offset(i, j, k)] = share_above(values_around(grid, field, i, j, k));
    });
    return shares;
}

}  // namespace vesselbench
