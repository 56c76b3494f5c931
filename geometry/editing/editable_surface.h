#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/editing/triangle_soup.h"

namespace vesselbench {

/// A surface whose structure can be edited: cut, filled, joined. Half-edges of OpenMesh, with patch
/// labels, attributes and marks as properties that go along.
///
/// Vertices and triangles keep their numbers until the surface is taken out again; new ones get
/// numbers beyond the last. What comes out has the order of these numbers, and a triangle its first
/// corner, so that an edit changes nothing but its own place, and a surface that is not edited
/// comes out bit for bit.
///
/// Where the input is no manifold, a triangle that OpenMesh cannot link stands apart on copies of
/// its vertices. The copies are not seen from outside: they move with their vertex, edges find all
/// their triangles, and the surface that comes out has the input's connectivity there.
class EditableSurface {
public:
    explicit EditableSurface(const Surface& surface);
    explicit EditableSurface(const TriangleSoup& soup);
    EditableSurface(EditableSurface&&) noexcept;
    EditableSurface& operator=(EditableSurface&&) noexcept;
    ~EditableSurface();

    /// Numbers of vertices and triangles are below these; removed ones count.
    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] std::size_t triangle_count() const;

    [[nodiscard]] Vec3 point(VertexId v) const;                               ///< [mm]
    [[nodiscard]] Positions points_of(std::span<const VertexId> loop) const;  ///< [mm]
    [[nodiscard]] Triangle triangle(TriangleId t) const;
    [[nodiscard]] Vec3 area_normal_of(TriangleId t) const;  ///< twice the area long [mm^2]
    [[nodiscard]] std::uint16_t label(TriangleId t) const;
    [[nodiscard]] bool is_removed(TriangleId t) const;

    /// Triangles at a vertex, ascending.
    [[nodiscard]] std::vector<TriangleId> triangles_at(VertexId v) const;

    /// Neighbours of a vertex, ascending.
    [[nodiscard]] std::vector<VertexId> ring(VertexId v) const;

    /// The other triangles on the side from corner `side` to the next one: none on a rim, one
    /// inside, more where the surface is no manifold.
    [[nodiscard]] std::vector<TriangleId> across(TriangleId t, int side) const;

    /// Triangles with the edge a-b, ascending.
    [[nodiscard]] std::vector<TriangleId> triangles_on(VertexId a, VertexId b) const;

    /// True if the vertex lies on an edge of one triangle only.
    [[nodiscard]] bool on_rim(VertexId v) const;

    /// Open rims of a manifold surface, each in the direction of its triangles' half-edges and from
    /// the start of its first half-edge in the order of triangles.
    [[nodiscard]] std::vector<std::vector<VertexId>> rims() const;

    void move(VertexId v, const Vec3& to);

    /// Gives a vertex the weighted mean of others' attributes (weights of sum 1).
    void blend_attributes(VertexId v, std::span<const VertexId> sources,
                          std::span<const double> weights);

    /// Adds a vertex whose attributes are the weighted mean of others' (weights of sum 1).
    VertexId add_vertex(const Vec3& point, std::span<const VertexId> sources,
                        std::span<const double> weights);

    TriangleId add_triangle(const Triangle& triangle, std::uint16_t label);

    /// Adds a patch; its label.
    std::uint16_t add_patch(Patch patch);

    [[nodiscard]] const std::vector<Patch>& patches() const;

    /// Adds another surface beside this one, not joined to it. Patches of the same name and kind
    /// become one; an attribute that only one of the two has is 0 on the other.
    /// \return number of its first vertex: its vertex v is now this plus v
    VertexId append(const Surface& other);

    void remove(TriangleId t);

    /// Removes the triangles marked 1 (one mark for each number).
    void remove(const std::vector<std::uint8_t>& marked);

    /// Merges a vertex into a neighbour, which keeps its place and attributes; the triangles on
    /// their edge go.
    /// \return false, and nothing is changed, where the surface would not stay a manifold
    bool collapse(VertexId gone, VertexId kept);

    /// Replaces a-b, an inner edge, by the other diagonal c-d of its two triangles: a, b, c and
    /// b, a, d become c, a, d and c, d, b.
    /// \param t the triangle a, b, c, which becomes c, a, d
    /// \param side from a to b
    /// \return false, and nothing is changed, where the edge is on a rim or c-d is an edge already
    bool flip(TriangleId t, int side);

    void set_label(TriangleId t, std::uint16_t label);

    /// Everything that is left, in plain arrays; unused vertices and patches are kept.
    [[nodiscard]] TriangleSoup to_soup() const;

    /// What is left, without vertices that no triangle uses and patches that have no triangle (the
    /// wall stays).
    /// \param new_ids if not null, receives each vertex' new number, or kRemovedVertex
    [[nodiscard]] Surface to_surface(std::vector<VertexId>* new_ids = nullptr) const;

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

/// Mean length of a closed loop's edges [mm].
[[nodiscard]] double mean_edge(const EditableSurface& surface, std::span<const VertexId> loop);
[[nodiscard]] double mean_edge(const Positions& points, std::span<const VertexId> loop);

}  // namespace vesselbench
