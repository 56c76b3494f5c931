#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/remeshing/edit_mesh.h"
#include "meshing/remeshing/remesh_target.h"

namespace vesselbench {

/// A surface under remeshing: its mesh, its target geometry, and each vertex's target edge length
/// and search hint; with the edits of single vertices and edges that the passes consist of, and the
/// conditions under which they preserve the surface.
struct RemeshState {
    using HalfEdge = EditMesh::HalfEdge;

    /// Edges longer than this, in target lengths, are split; no edit creates one.
    static constexpr double kLong = 4.0 / 3.0;

    struct VertexKind {
        int features = 0;            ///< feature edges at the vertex: 0 inside a patch, 2 on a rim
        std::uint32_t p = 0, q = 0;  ///< the patches it belongs to; on rims both
    };

    /// \param source the target geometry of the result
    /// \param source_sizes target edge length at each vertex of the source [mm], #V
    /// \param start the initial mesh: the source, or one near it with the same patches
    /// \param end by which the passes are cancelled
    /// \throw InvalidInput that names the place if the start is not an oriented manifold
    RemeshState(const Surface& source, const std::vector<double>& source_sizes,
                const Surface& start, const Progress& end = {});

    /// In every turn of a long loop. \throw Cancelled if the user cancels
    void check_cancelled() {
        constexpr unsigned kTurns = 1024;
        if (++turns % kTurns == 0) cancel.check_cancelled();
    }

    [[nodiscard]] VertexKind kind_of(VertexId v) const;

    /// True for the vertex that closes a hole of the surface: it is not part of the result.
    [[nodiscard]] bool is_hub(VertexId v) const;

    /// Splits the edge of h at its middle, which may be off the source. \return the new vertex
    VertexId split(HalfEdge h);

    /// The place on the source, on the patch or rim of the vertex, that is closest to x.
    [[nodiscard]] TargetPlace place_for(VertexId v, const VertexKind& kind, const Vec3& x) const;

    /// True for vertices that no pass may move.
    [[nodiscard]] bool rests(VertexId v) const { return v < resting.size() && resting[v] != 0; }

    /// True for vertices that are neither moved nor removed.
    [[nodiscard]] bool is_anchored(VertexId v) const {
        return v < anchors.size() && anchors[v] != EditMesh::kNone;
    }

    /// An edge of a rim that no pass may split.
    [[nodiscard]] bool is_anchored_rim(HalfEdge h) const {
        return is_anchored(mesh.origin(h)) && is_anchored(mesh.target(h)) && mesh.is_feature(h);
    }

    /// From now on these vertices of the start stay where they are, and are part of the result.
    /// \param anchored 1 at them, by vertex of the start
    void anchor(std::span<const std::uint8_t> anchored);

    [[nodiscard]] double wanted(VertexId a, VertexId b) const {
        return 0.5 * (sizes[a] + sizes[b]);
    }

    [[nodiscard]] double length(HalfEdge h) const {
        return (mesh.points[mesh.origin(h)] - mesh.points[mesh.target(h)]).norm();
    }

    /// Unit mean normal of the triangles at v, by area.
    [[nodiscard]] Vec3 normal_at(VertexId v) const;

    /// True if collapsing h preserves rims, creates no edge longer than `limit` target lengths and
    /// folds nothing over. Edges that are already too long may stay so.
    [[nodiscard]] bool may_collapse(HalfEdge h, double limit) const;

    [[nodiscard]] bool flip_keeps_shape(HalfEdge h) const;
    [[nodiscard]] bool move_keeps_shape(VertexId v, const Vec3& x) const;
    void move(VertexId v, const TargetPlace& place);

    /// Drops what was removed; vertices and half-edges get new numbers (EditMesh::compact).
    void compact();

    /// The remeshed surface with the source's patches; attributes are not set.
    [[nodiscard]] Surface result() const;

    RemeshTarget target;
    EditMesh mesh;
    std::vector<Patch> patches;
    std::vector<double> sizes;            ///< target edge length by vertex [mm]
    std::vector<TriangleId> hints;        ///< by vertex: the source's triangle where searches begin
    std::vector<std::uint32_t> inner_of;  ///< by vertex: its patch; kNone on rims
    std::vector<std::uint8_t> resting;    ///< by vertex; those beyond the end do not rest
    /// By vertex: its number in the start if it is anchored, else kNone; empty: none is.
    std::vector<VertexId> anchors;
    Progress cancel;
    unsigned turns = 0;  ///< of loops
};

}  // namespace vesselbench
