#include "geometry/kernel/edges.h"

#include <algorithm>
#include <limits>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

struct HalfEdge {
    VertexId high;
    std::uint32_t id;

    bool operator<(const HalfEdge& other) const {
        return high < other.high || (high == other.high && id < other.id);
    }
};

/// Vertices whose triangles, connected across shared edges only, form several fans.
std::vector<VertexId> several_fans(const Topology& topology, const EdgeTable& edges) {
    // A corner (triangle, k) is joined with the corner at the same vertex across an edge.
    const auto triangles = topology.triangles();
    DisjointSets corners(triangles.size() * 3);
    const auto half_edge = [&](std::uint32_t triangle, VertexId v) {
        return triangle * 3 + corner_of(triangles[triangle], v);
    };
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
        const auto row = edges.half_edges.row(e);
        for (std::size_t i = 1; i < row.size(); ++i)
            for (const VertexId v : edges.edges[e])
                corners.join(half_edge(row[0] / 3, v), half_edge(row[i] / 3, v));
    }
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> fan(topology.vertex_count(), kNone);
    std::vector<VertexId> found;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (names_vertex_twice(triangles[t])) continue;
        for (const VertexId v : triangles[t]) {
            const std::uint32_t root = corners.root(half_edge(t, v));
            if (fan[v] == kNone) fan[v] = root;
            if (fan[v] != root) found.push_back(v);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace

EdgeTable edge_table(const Topology& topology, const Progress& cancel) {
    constexpr std::uint32_t kPiece = 1U << 16U;  // a few milliseconds
    const auto triangles = topology.triangles();
    // Counting sort by the low vertex, then small sorts by the high one.
    std::vector<std::uint32_t> offsets(topology.vertex_count() + 1, 0);
    const auto for_each = [&](auto&& visit) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            if (t % kPiece == 0) cancel.check_cancelled();
            for (std::uint32_t k = 0; k < 3; ++k) {
                const VertexId a = triangles[t][k], b = triangles[t][(k + 1) % 3];
                if (a != b) visit(std::min(a, b), std::max(a, b), 3 * t + k);
            }
        }
    };
    for_each([&](VertexId low, VertexId, std::uint32_t) { ++offsets[low + 1]; });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<HalfEdge> sorted(offsets.back());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for_each([&](VertexId low, VertexId high, std::uint32_t id) {
        sorted[next[low]++] = {high, id};
    });
    EdgeTable table;
    table.edges.reserve(sorted.size() / 2 + 16);
    table.half_edges.values.reserve(sorted.size());
    table.half_edges.offsets.reserve(sorted.size() / 2 + 17);
    for (VertexId low = 0; low < topology.vertex_count(); ++low) {
        if (low % kPiece == 0) cancel.check_cancelled();
        std::sort(sorted.begin() + offsets[low], sorted.begin() + offsets[low + 1]);
        for (std::uint32_t i = offsets[low]; i < offsets[low + 1]; ++i) {
            if (i == offsets[low] || sorted[i].high != sorted[i - 1].high) {
                table.edges.push_back({low, sorted[i].high});
                table.half_edges.offsets.push_back(i);
            }
            table.half_edges.values.push_back(sorted[i].id);
        }
    }
    table.half_edges.offsets.push_back(static_cast<std::uint32_t>(sorted.size()));
    return table;
}

ManifoldDefects manifold_defects(const Topology& topology) {
    return manifold_defects(topology, edge_table(topology));
}

ManifoldDefects manifold_defects(const Topology& topology, const EdgeTable& edges) {
    ManifoldDefects defects;
    const auto triangles = topology.triangles();
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
        const auto row = edges.half_edges.row(e);
        if (row.size() > 2) defects.edges.push_back(edges.edges[e]);
        if (row.size() == 2 &&
            triangles[row[0] / 3][row[0] % 3] == triangles[row[1] / 3][row[1] % 3])
            defects.inconsistent_edges.push_back(edges.edges[e]);
    }
    defects.vertices = several_fans(topology, edges);
    for (TriangleId t = 0; t < triangles.size(); ++t)
        if (names_vertex_twice(triangles[t])) defects.degenerate.push_back(t);
    return defects;
}

std::size_t Components::largest() const {
    return static_cast<std::size_t>(
        std::max_element(triangle_counts.begin(), triangle_counts.end()) - triangle_counts.begin());
}

Components connected_components(const Topology& topology) {
    DisjointSets sets(topology.vertex_count());
    for (const Triangle& t : topology.triangles()) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(topology.vertex_count(), kNone);
    Components parts;
    parts.of_triangle.reserve(topology.triangle_count());
    for (const Triangle& t : topology.triangles()) {
        std::uint32_t& mine = number[sets.root(t[0])];
        if (mine == kNone) {
            mine = static_cast<std::uint32_t>(parts.triangle_counts.size());
            parts.triangle_counts.push_back(0);
        }
        ++parts.triangle_counts[mine];
        parts.of_triangle.push_back(mine);
    }
    return parts;
}

Surface select_triangles(const Surface& surface, const std::vector<bool>& keep) {
    if (keep.size() != surface.triangle_count())
        throw InvalidInput("got " + std::to_string(keep.size()) + " choices for " +
                           std::to_string(surface.triangle_count()) + " triangles");
    constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
    std::vector<VertexId> number(surface.vertex_count(), kUnused);
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (TriangleId t = 0; t < keep.size(); ++t) {
        if (!keep[t]) continue;
        triangles.push_back(surface.triangles()[t]);
        labels.push_back((*surface.patch_labels)[t]);
        for (const VertexId v : triangles.back()) number[v] = 0;
    }
    Positions positions;
    std::vector<VertexId> kept;
    for (VertexId v = 0; v < number.size(); ++v) {
        if (number[v] == kUnused) continue;
        number[v] = static_cast<VertexId>(kept.size());
        kept.push_back(v);
        positions.push_back(surface.points()[v]);
    }
    for (Triangle& t : triangles)
        for (VertexId& v : t) v = number[v];
    Surface result = make_surface(std::move(positions), std::move(triangles), std::move(labels),
                                  surface.patches);
    for (const auto& [name, values] : surface.attributes) {
        std::vector<double> chosen;
        chosen.reserve(kept.size());
        for (const VertexId v : kept) chosen.push_back((*values)[v]);
        result.attributes[name] = std::make_shared<const std::vector<double>>(std::move(chosen));
    }
    return result;
}

Surface flipped(const Surface& surface) {
    std::vector<Triangle> triangles(surface.triangles().begin(), surface.triangles().end());
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
    Surface result = surface;
    result.topology =
        std::make_shared<const Topology>(std::move(triangles), surface.vertex_count());
    return result;
}

}  // namespace vesselbench
