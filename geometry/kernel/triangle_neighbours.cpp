#include "geometry/kernel/triangle_neighbours.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace vesselbench {

std::vector<std::array<TriangleId, 3>> edge_neighbours(std::span<const Triangle> triangles) {
    struct Side {
        VertexId low, high;
        TriangleId triangle;
        std::uint8_t edge;
    };

    const auto for_each_side = [&](auto&& visit) {
        for (TriangleId t = 0; t < triangles.size(); ++t)
            for (std::uint8_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1U) % 3]);
                visit(Side{low, high, t, k});
            }
    };
    VertexId vertices = 0;
    for (const Triangle& corners : triangles)
        vertices = std::max(vertices, *std::ranges::max_element(corners) + 1);
    // Counting sort by the low vertex, then small sorts by the high one.
    std::vector<std::uint32_t> offsets(vertices + std::size_t{1}, 0);
    for_each_side([&](const Side& side) { ++offsets[side.low + 1]; });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<Side> sides(3 * triangles.size());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for_each_side([&](const Side& side) { sides[next[side.low]++] = side; });
    for (VertexId v = 0; v < vertices; ++v)
        std::sort(sides.begin() + offsets[v], sides.begin() + offsets[v + 1],
                  [](const Side& x, const Side& y) { return x.high < y.high; });
    std::vector<std::array<TriangleId, 3>> near(triangles.size(),
                                                {kNoTriangle, kNoTriangle, kNoTriangle});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high) {
            ++end;
        }
        if (end - i == 2) {
            near[sides[i].triangle][sides[i].edge] = sides[i + 1].triangle;
            near[sides[i + 1].triangle][sides[i + 1].edge] = sides[i].triangle;
        }
        i = end;
    }
    return near;
}

}  // namespace vesselbench
