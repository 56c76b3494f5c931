#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"

namespace vesselbench {

inline constexpr TriangleId kNoTriangle = static_cast<TriangleId>(-1);

/// The triangle across each of a triangle's edges, #T x 3; kNoTriangle unless there is exactly one.
[[nodiscard]] std::vector<std::array<TriangleId, 3>> edge_neighbours(
    std::span<const Triangle> triangles);

}  // namespace vesselbench
