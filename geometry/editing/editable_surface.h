#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/editing/triangle_soup.h"

namespace vesselbench {

/// A surface whose structure can be edited: cut, filled, joined. OpenMesh half-edges, with patch
/// labels, attributes and marks as properties.
///
/// Vertices and triangles keep their numbers until the surface is extracted; new ones are numbered
/// after the last. The extracted arrays follow this order, and each triangle keeps its first
/// corner, so an edit changes only what it touches, and an unedited surface comes out bit for bit.
///
/// Where the input is not a manifold, a triangle that OpenMesh cannot link uses copies of its
/// vertices. Callers do not see the copies: they move with their vertex, edges find all their
/// triangles, and the extracted surface has the input's connectivity there.
class EditableSurface {
public:
    explicit EditableSurface(const Surface& surface);
    explicit EditableSurface(const TriangleSoup& soup);
    EditableSurface(EditableSurface&&) noexcept;
    EditableSurface& operator=(EditableSurface&&) noexcept;
    ~EditableSurface();

    /// Vertex and triangle numbers are below these; removed ones are included.
    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] std::size_t triangle_count() const;

    [[nodiscard]] Vec3 point(VertexId v) const;                               ///< [mm]
    [[nodiscard]] Positions points_of(std::span<const VertexId> loop) const;  ///< [mm]
    [[nodiscard]] Triangle triangle(TriangleId t) const;
    [[nodiscard]] Vec3 area_normal_of(TriangleId t) const;  ///< its length is twice the area [mm^2]
    [[nodiscard]] std::uint16_t label(TriangleId t) const;
    [[nodiscard]] bool is_removed(TriangleId t) const;

    /// Triangles at a vertex, ascending.
    [[nodiscard]] std::vector<TriangleId> triangles_at(VertexId v) const;

    /// Neighbours of a vertex, ascending.
    [[nodiscard]] std::vector<VertexId> ring(VertexId v) const;

    /// The other triangles on the edge from corner `side` to the next one: none on a rim, one
    /// inside, more at a non-manifold edge.
    [[nodiscard]] std::vector<TriangleId> across(TriangleId t, int side) const;

    /// Triangles with the edge a-b, ascending.
    [[nodiscard]] std::vector<TriangleId> triangles_on(VertexId a, VertexId b) const;

    /// True if the vertex lies on an edge of one triangle only.
    [[nodiscard]] bool on_rim(VertexId v) const;

    /// Open rims of a manifold surface, each in the direction of its triangles' half-edges,
    /// starting at its first half-edge in triangle order.
    [[nodiscard]] std::vector<std::vector<VertexId>> rims() const;

    void move(VertexId v, const Vec3& to);

    /// Sets a vertex's attributes to the weighted mean of other vertices' (weights sum to 1).
    void blend_attributes(VertexId v, std::span<const VertexId> sources,
                          std::span<const double> weights);

    /// Adds a vertex whose attributes are the weighted mean of other vertices' (weights sum to 1).
    VertexId add_vertex(const Vec3& point, std::span<const VertexId> sources,
                        std::span<const double> weights);

    TriangleId add_triangle(const Triangle& triangle, std::uint16_t label);

    /// Adds a patch and returns its label.
    std::uint16_t add_patch(Patch patch);

    [[nodiscard]] const std::vector<Patch>& patches() const;

    /// Adds another surface, not connected to this one. Patches of the same name and kind are
    /// merged; an attribute that only one of the two has is 0 on the other.
    /// \return the number of its first vertex: its vertex v becomes this plus v
    VertexId append(const Surface& other);

    void remove(TriangleId t);

    /// Removes the triangles marked 1 (one mark per triangle number).
    void remove(const std::vector<std::uint8_t>& marked);

    /// Merges a vertex into a neighbour, which keeps its position and attributes; the triangles on
    /// their edge are removed.
    /// \return false, changing nothing, if the surface would not stay a manifold
    bool collapse(VertexId gone, VertexId kept);

    /// Replaces the inner edge a-b by the other diagonal c-d of its two triangles: a, b, c and b,
    /// a, d become c, a, d and c, d, b.
    /// \param t the triangle a, b, c, which becomes c, a, d
    /// \param side from a to b
    /// \return false, changing nothing, if the edge is on a rim or c-d is already an edge
    bool flip(TriangleId t, int side);

    void set_label(TriangleId t, std::uint16_t label);

    /// What remains, in plain arrays; unused vertices and patches are kept.
    [[nodiscard]] TriangleSoup to_soup() const;

    /// What remains, without unused vertices and empty patches (the wall stays).
    /// \param new_ids if not null, receives each vertex's new number, or kRemovedVertex
    [[nodiscard]] Surface to_surface(std::vector<VertexId>* new_ids = nullptr) const;

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

/// Mean length of a closed loop's edges [mm].
[[nodiscard]] double mean_edge(const EditableSurface& surface, std::span<const VertexId> loop);
[[nodiscard]] double mean_edge(const Positions& points, std::span<const VertexId> loop);

}  // namespace vesselbench
