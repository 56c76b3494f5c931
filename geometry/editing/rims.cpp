#include "geometry/editing/rims.h"

#include <algorithm>

#include "geometry/editing/flat_cap.h"

namespace vesselbench {

namespace {

/// Fraction of the i-th point, continued beyond one turn.
double share_of(std::span<const double> shares, std::size_t i) {
    return shares[i % shares.size()] + (i >= shares.size() ? 1.0 : 0.0);
}

/// Fractions of the way around by arc length.
Ring ring_of(const EditableSurface& surface, std::vector<VertexId> vertices) {
    Ring ring{std::move(vertices), {}};
    const double length =
        mean_edge(surface, ring.vertices) * static_cast<double>(ring.vertices.size());
    double way = 0.0;
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
        if (i > 0)
            way += (surface.point(ring.vertices[i]) - surface.point(ring.vertices[i - 1])).norm();
        ring.shares.push_back(way / length);
    }
    return ring;
}

}  // namespace

std::vector<Triangle> band_between(std::span<const double> lower, std::span<const double> upper) {
    std::vector<Triangle> triangles;
    const auto n = static_cast<VertexId>(lower.size()), m = static_cast<VertexId>(upper.size());
    for (VertexId i = 0, j = 0; i < n || j < m;) {
        const VertexId a = i % n, b = n + j % m;
        // Advance on the ring whose next edge has its middle first.
        const bool below = j == m || (i < n && share_of(lower, i + 1) + share_of(lower, i) <
                                                   share_of(upper, j + 1) + share_of(upper, j));
        if (below)
            triangles.push_back({a, ++i % n, b});
        else
            triangles.push_back({a, n + ++j % m, b});
    }
    return triangles;
}

void join_rings(EditableSurface& surface, const Ring& lower, const Ring& upper,
                std::uint16_t label) {
    std::vector<VertexId> ids = lower.vertices;
    ids.insert(ids.end(), upper.vertices.begin(), upper.vertices.end());
    for (const auto& [a, b, c] : band_between(lower.shares, upper.shares))
        surface.add_triangle({ids[a], ids[b], ids[c]}, label);
}

void join_rims(EditableSurface& surface, std::span<const VertexId> rim,
               std::span<const VertexId> other, std::uint16_t label) {
    std::vector<VertexId> lower(rim.rbegin(), rim.rend()), upper(other.begin(), other.end());
    const Vec3 start = surface.point(lower.front());
    const auto nearest = std::min_element(upper.begin(), upper.end(), [&](VertexId a, VertexId b) {
        return (surface.point(a) - start).squaredNorm() < (surface.point(b) - start).squaredNorm();
    });
    std::rotate(upper.begin(), nearest, upper.end());
    join_rings(surface, ring_of(surface, std::move(lower)), ring_of(surface, std::move(upper)),
               label);
}

void close_flat(EditableSurface& surface, std::span<const VertexId> loop, const Plane& plane,
                double edge, std::uint16_t label) {
    const FlatCap cap = fill_flat(surface.points_of(loop), plane, edge);
    const std::vector<double> equal(loop.size(), 1.0 / static_cast<double>(loop.size()));
    std::vector<VertexId> ids(loop.begin(), loop.end());
    for (const Vec3& p : cap.inner) ids.push_back(surface.add_vertex(p, loop, equal));
    for (const auto& [a, b, c] : cap.triangles)
        surface.add_triangle({ids[a], ids[b], ids[c]}, label);
}

}  // namespace vesselbench
