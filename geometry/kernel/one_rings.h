#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/triangles.h"

namespace vesselbench {

/// The one-ring neighbours of every vertex, and which vertices lie on a boundary.
struct OneRings {
    CompressedRows rows;                 ///< #V rows, each ascending and without repetition
    std::vector<std::uint8_t> boundary;  ///< 1 on an edge that has exactly one triangle, #V
};

/// Collects the one-rings of any triangles, even degenerate and non-manifold ones, on all threads:
/// linear in triangles, and the same rows for any number of threads.
/// \param triangles every index below vertex_count, which is below 2^31
[[nodiscard]] OneRings one_rings(std::span<const Triangle> triangles, std::size_t vertex_count);

}  // namespace vesselbench
