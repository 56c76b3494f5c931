#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A triangle mesh whose connectivity can be edited: split, collapse and flip of an edge in
/// constant time on flat arrays. Half-edge h = 3 t + i goes from corner i of triangle t to corner
/// (i + 1) % 3.
///
/// The mesh is always closed: each boundary loop of an open surface is filled with triangles to one
/// virtual vertex, which form a separate hole patch and have no geometry. An edge is a *feature* if
/// the patches of its two triangles differ: rims of caps and open boundaries are features, and an
/// edit that preserves patches preserves them.
class EditMesh {
public:
    using HalfEdge = std::uint32_t;
    static constexpr std::uint32_t kNone = 0xffffffffU;

    /// \throw InvalidInput that names the place if the surface is not an oriented manifold
    explicit EditMesh(const Surface& surface);

    [[nodiscard]] static HalfEdge next(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

    [[nodiscard]] static HalfEdge prev(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

    [[nodiscard]] static TriangleId triangle_of(HalfEdge h) { return h / 3; }

    [[nodiscard]] VertexId origin(HalfEdge h) const { return origin_[h]; }

    [[nodiscard]] VertexId target(HalfEdge h) const { return origin_[next(h)]; }

    [[nodiscard]] VertexId apex(HalfEdge h) const { return origin_[prev(h)]; }

    [[nodiscard]] HalfEdge twin(HalfEdge h) const { return twin_[h]; }

    /// One half-edge leaving v; kNone if v is removed.
    [[nodiscard]] HalfEdge leaving(VertexId v) const { return leaving_[v]; }

    /// The next half-edge leaving the same vertex, clockwise from h.
    [[nodiscard]] HalfEdge around(HalfEdge h) const { return twin_[prev(h)]; }

    [[nodiscard]] std::size_t half_edge_count() const { return origin_.size(); }

    [[nodiscard]] std::size_t triangle_count() const {
        return patch_.size();
    }  ///< including removed ones

    [[nodiscard]] std::size_t vertex_count() const {
        return points.size();
    }  ///< including removed ones

    [[nodiscard]] bool is_alive(TriangleId t) const { return origin_[3 * t] != kNone; }

    [[nodiscard]] std::uint32_t patch(TriangleId t) const { return patch_[t]; }

    [[nodiscard]] std::uint32_t patch_at(HalfEdge h) const { return patch_[h / 3]; }

    [[nodiscard]] bool is_hole(std::uint32_t patch) const { return patch >= first_hole_; }

    [[nodiscard]] bool is_feature(HalfEdge h) const { return patch_at(h) != patch_at(twin_[h]); }

    /// Calls visit(h) for every half-edge leaving v.
    template <class Visit>
    void for_each_leaving(VertexId v, const Visit& visit) const {
        const HalfEdge start = leaving_[v];
        HalfEdge h = start;
        do {
            visit(h);
            h = around(h);
        } while (h != start);
    }

    [[nodiscard]] int valence(VertexId v) const;
    /// The origin of h has at most three edges.
    [[nodiscard]] bool closes_within_three(HalfEdge h) const;
    [[nodiscard]] bool are_neighbours(VertexId a, VertexId b) const;

    /// Splits the edge of h at a new vertex at `point`, which it returns; h keeps its origin.
    VertexId split(HalfEdge h, const Vec3& point);

    /// True if the edge may be flipped to the other diagonal: no feature, no hole, no double edge.
    [[nodiscard]] bool can_flip(HalfEdge h) const;
    void flip(HalfEdge h);

    /// True if merging the origin of h into its target preserves the manifold and its
    /// topology.
    [[nodiscard]] bool can_collapse(HalfEdge h) const;
    /// Merges the origin of h into its target, which does not move.
    void collapse(HalfEdge h);

    /// Closes the gaps of what was removed and gives everything new numbers: vertices along a curve
    /// that fills space, triangles by their lowest vertex. What the passes visit together then lies
    /// together in memory, however the mesh came about.
    /// \return the former number of each vertex
    std::vector<VertexId> compact();

    /// Area normal of triangle t [mm^2], its length is twice the area.
    [[nodiscard]] Vec3 area_normal_of(TriangleId t) const {
        const Vec3& a = points[origin_[3 * t]];
        return (points[origin_[3 * t + 1]] - a).cross(points[origin_[3 * t + 2]] - a);
    }

    /// The surface without holes and removed parts; vertices keep their order.
    /// \param kept receives, for each vertex of the result, its number here
    [[nodiscard]] Surface to_surface(const std::vector<Patch>& patches,
                                     std::vector<VertexId>& kept) const;

    Positions points;  ///< [mm], by vertex; undefined for removed and virtual vertices

private:
    void add_triangle(VertexId a, VertexId b, VertexId c, std::uint32_t patch);
    void glue(HalfEdge g, HalfEdge h);
    void find_twins(const Surface& surface);
    void fill_holes();
    void require_single_fans() const;
    [[nodiscard]] int feature_edges_at(VertexId v) const;
    std::vector<VertexId> compact_vertices();
    void compact_triangles();
    [[nodiscard]] int common_neighbours(VertexId a, VertexId b) const;

    std::vector<VertexId> origin_;      ///< by half-edge; kNone where removed
    std::vector<HalfEdge> twin_;        ///< by half-edge
    std::vector<HalfEdge> leaving_;     ///< by vertex
    std::vector<std::uint32_t> patch_;  ///< by triangle
    std::uint32_t first_hole_ = 0;      ///< patches from here on are holes
};

}  // namespace vesselbench
