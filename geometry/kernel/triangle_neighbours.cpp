#include "geometry/kernel/triangle_neighbours.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace vesselbench {

std::vector<std::array<TriangleId, 3>> edge_neighbours(std::span<const Triangle> triangles) {
    struct Side {
        VertexId a, b;
        TriangleId triangle;
        std::uint8_t edge;
    };

    std::vector<Side> sides;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(triangles[t][k], triangles[t][(k + 1U) % 3]);
            sides.push_back({a, b, t, k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return std::tie(x.a, x.b, x.triangle, x.edge) < std::tie(y.a, y.b, y.triangle, y.edge);
    });
    std::vector<std::array<TriangleId, 3>> near(triangles.size(),
                                                {kNoTriangle, kNoTriangle, kNoTriangle});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b) {
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
