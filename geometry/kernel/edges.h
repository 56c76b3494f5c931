#pragma once

#include <array>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The corner (0 to 2) of a triangle at a vertex; in a degenerate triangle the first one.
[[nodiscard]] inline std::uint32_t corner_of(const Triangle& triangle, VertexId v) {
    return triangle[0] == v ? 0 : triangle[1] == v ? 1 : 2;
}

[[nodiscard]] inline bool names_vertex_twice(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Every edge once, with its half-edges (triangle corners).
struct EdgeTable {
    std::vector<std::array<VertexId, 2>> edges;  ///< {low, high}, ascending
    /// Per edge the half-edges 3 * triangle + k, ascending; half-edge k runs from corner k to
    /// corner k + 1 (mod 3). One: a boundary edge; two: an inner edge; more: a non-manifold edge.
    CompressedRows half_edges;
};

/// Edges between a vertex and itself (degenerate triangles) are left out.
/// \throw Cancelled if the user cancels
[[nodiscard]] EdgeTable edge_table(const Topology& topology, const Progress& cancel = {});

/// Defects that make connectivity differ from a manifold with boundary.
struct ManifoldDefects {
    std::vector<std::array<VertexId, 2>> edges;  ///< edges with three or more triangles
    std::vector<VertexId> vertices;              ///< whose triangles form more than one fan
    std::vector<std::array<VertexId, 2>> inconsistent_edges;  ///< both triangles run the same way
    std::vector<TriangleId> degenerate;  ///< triangles that name a vertex twice

    [[nodiscard]] bool none() const {
        return edges.empty() && vertices.empty() && inconsistent_edges.empty() &&
               degenerate.empty();
    }
};

[[nodiscard]] ManifoldDefects manifold_defects(const Topology& topology);
[[nodiscard]] ManifoldDefects manifold_defects(const Topology& topology, const EdgeTable& edges);

/// Connected parts of a surface: triangles that share a vertex belong together.
struct Components {
    std::vector<std::uint32_t> of_triangle;  ///< #T, numbered by first triangle
    std::vector<std::size_t> triangle_counts;

    [[nodiscard]] std::size_t count() const { return triangle_counts.size(); }

    /// The component with the most triangles; the first of equals. 0 if there is none.
    [[nodiscard]] std::size_t largest() const;
};

[[nodiscard]] Components connected_components(const Topology& topology);

/// The triangles with `keep` true, with their vertices, patches and attributes; order is kept,
/// unused vertices are dropped. The patch table stays complete.
/// \throw InvalidInput unless keep is #T long
[[nodiscard]] Surface select_triangles(const Surface& surface, const std::vector<bool>& keep);

/// The same shape with reversed triangles (patches and attributes kept).
[[nodiscard]] Surface flipped(const Surface& surface);

}  // namespace vesselbench
