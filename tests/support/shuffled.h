#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// The same surface with its vertices numbered at random; `numbers`: old to new. Triangles keep
/// their numbers.
inline Surface shuffled(const Surface& surface, std::vector<VertexId>& numbers) {
    numbers.resize(surface.vertex_count());
    std::iota(numbers.begin(), numbers.end(), 0U);
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(3));
    Positions points(numbers.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) points[numbers[v]] = surface.points()[v];
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles())
        triangles.push_back({numbers[a], numbers[b], numbers[c]});
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace vesselbench::test
