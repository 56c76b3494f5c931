#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Triangles in plain arrays that can be added and removed one by one. They need not be manifold:
/// raw input is welded, split and cropped in this form. Algorithms that need neighbours use an
/// EditableSurface.
struct TriangleSoup {
    Positions points;  ///< [mm]
    std::vector<Triangle> triangles;
    PatchLabels labels;  ///< #T
    std::vector<Patch> patches;
    std::map<std::string, std::vector<double>> attributes;  ///< each #V
    std::vector<std::uint8_t> marks;                        ///< #V, for the caller; 0 if new

    /// Adds a vertex whose attributes are the weighted mean of other vertices' (weights sum to 1).
    VertexId add_vertex(const Vec3& point, std::span<const VertexId> sources,
                        std::span<const double> weights);

    /// Adds a vertex with the mean of the attributes of `around`.
    VertexId add_vertex_between(const Vec3& point, std::span<const VertexId> around);

    /// Adds a vertex at the same place, with the same attributes and mark.
    VertexId add_copy(VertexId of);

    void add_triangle(const Triangle& triangle, std::uint16_t label);

    /// Removes the triangles marked 1 (#T). Vertices and patches stay; the order is kept.
    void remove_triangles(const std::vector<std::uint8_t>& marked);

    /// Removes vertices that no triangle uses, keeping the order.
    /// \param new_ids if not null, receives each vertex's new number, or kRemovedVertex
    /// \return their number
    std::size_t remove_unused_vertices(std::vector<VertexId>* new_ids = nullptr);

    /// Removes the patches that have no triangle, keeping the order; the wall stays.
    void remove_unused_patches();

    /// Replaces vertex v by `target[v]` (a kept vertex) in all triangles.
    void renumber(const std::vector<VertexId>& target);
};

inline constexpr VertexId kRemovedVertex = static_cast<VertexId>(-1);

[[nodiscard]] TriangleSoup soup_from(const Surface& surface);
[[nodiscard]] Surface surface_from(TriangleSoup soup);

}  // namespace vesselbench
