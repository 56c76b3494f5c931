#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

// Small per-vertex fields that remeshing needs.

/// Outward unit normals, weighted by area: of the wall at its vertices, rims included, of a cap at
/// vertices inside it; zero if no triangle has an area. #V
[[nodiscard]] Positions wall_normals(const Surface& surface);

/// Weights of a triangle's vertices at a point of it, in [0, 1]; {a, b, b} and other triangles
/// without area are treated as segments.
[[nodiscard]] Vec3 barycentric(const Positions& points, const Triangle& triangle, const Vec3& at);

/// Which cap each vertex belongs to.
struct VertexCaps {
    std::vector<std::uint16_t> patch;  ///< index of the cap's patch; 0: on the wall only
    std::vector<std::uint8_t> on_rim;  ///< 1 if wall and cap meet
};

[[nodiscard]] VertexCaps caps_of_vertices(const Surface& surface);

/// Sets every vertex of value 0 to the value of the nearest other one, counted in edges.
void fill_zeros(const Topology& topology, std::vector<double>& values);

/// Replaces every value by the mean of its own and its neighbours' mean, `passes` times.
void average(const Topology& topology, int passes, std::vector<double>& values);

}  // namespace vesselbench
