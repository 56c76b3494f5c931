#include "geometry/kernel/solid_surface.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/kernel/edges.h"

namespace vesselbench {

namespace {

/// Whether every connected part of a closed surface encloses a positive volume.
bool all_parts_outward(const Surface& surface) {
    const Components parts = connected_components(*surface.topology);
    std::vector<double> volumes(parts.count(), 0.0);
    const Vec3 origin = surface.points().front();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        const auto from_origin = [&](VertexId v) { return Vec3(surface.points()[v] - origin); };
        volumes[parts.of_triangle[t]] += from_origin(a).dot(from_origin(b).cross(from_origin(c)));
    }
    return std::ranges::all_of(volumes, [](double volume) { return volume > 0.0; });
}

}  // namespace

bool is_solid_surface(const Surface& surface) {
    // Every half-edge has one opposite: sums of hashes of both kinds cancel, else by chance only.
    const auto hashed = [](VertexId from, VertexId to) {
        std::uint64_t x = (std::uint64_t{from} << 32 | to) * 0x9E3779B97F4A7C15U;
        x = (x ^ x >> 29) * 0xBF58476D1CE4E5B9U;
        return x ^ x >> 32;
    };
    std::uint64_t sum = 0;
    for (const auto& [a, b, c] : surface.triangles()) {
        sum += hashed(a, b) + hashed(b, c) + hashed(c, a);
        sum -= hashed(b, a) + hashed(c, b) + hashed(a, c);
    }
    return sum == 0 && all_parts_outward(surface);
}

}  // namespace vesselbench
