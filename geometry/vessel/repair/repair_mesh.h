#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What the steps of repair work on: a triangle soup with everything that must be carried along.
struct RepairMesh {
    Positions points;
    std::vector<Triangle> triangles;
    PatchLabels labels;                                  ///< #T
    std::map<std::string, std::vector<double>> columns;  ///< attributes, each #V
    std::vector<std::uint8_t> cut;  ///< #V, 1 at the rim of what repair itself cut out

    [[nodiscard]] VertexId add_copy(VertexId of);

    /// Adds a vertex with the mean of the attributes of `around`.
    [[nodiscard]] VertexId add_vertex(const Vec3& point, const std::vector<VertexId>& around);

    void add_triangle(const Triangle& triangle, std::uint16_t label);

    /// Removes the triangles marked 1. Vertices stay.
    void remove_triangles(const std::vector<std::uint8_t>& marked);

    /// Removes vertices that no triangle uses, keeping the order. \return their number
    std::size_t remove_unused_vertices();

    /// Gives vertex v the number `target[v]` (of a kept vertex) in all triangles.
    void renumber(const std::vector<VertexId>& target);
};

[[nodiscard]] RepairMesh repair_mesh_from(const Surface& surface);
[[nodiscard]] Surface surface_from(RepairMesh mesh, const std::vector<Patch>& patches);

/// Mean edge length over all triangle sides [mm].
[[nodiscard]] double mean_side(const RepairMesh& mesh);

[[nodiscard]] Vec3 centroid(const RepairMesh& mesh, const Triangle& triangle);

}  // namespace vesselbench
