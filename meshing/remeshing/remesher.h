#pragma once

#include <vector>

#include "meshing/remeshing/edit_mesh.h"
#include "meshing/remeshing/remesh_target.h"

namespace vesselbench {

/// A surface under remeshing: its mesh, what it has to lie on, and for each vertex the wanted edge
/// length and a hint for the next search. The steps below are sequential and visit edges and
/// vertices in the order of their numbers, so that the same input gives the same bits.
class Remesher {
public:
    /// \param source what the result has to lie on
    /// \param sizes wanted edge length at each vertex of the source [mm], #V
    /// \param start the mesh to begin with: the source, or one near it with the same patches
    /// \throw InvalidInput that names the place if the start is not an oriented manifold
    Remesher(const Surface& source, const std::vector<double>& sizes, const Surface& start);

    static constexpr double kLong = 4.0 / 3.0;

    /// Edges come out this much longer than `sizes` say [-] (seen on tubes and vessels).
    static constexpr double kStretch = 1.07;

    /// Splits edges that are longer than `limit` wanted lengths, until there are none.
    void split_long_edges(double limit = kLong);

    /// Collapses edges that are shorter than 4/5 of the wanted length, where that keeps rims,
    /// makes no long edge and folds nothing over.
    void collapse_short_edges();

    /// Collapses edges of any length where that brings no valence farther from six on the whole: a
    /// mesh that only fits its edge lengths is full of pairs of five and seven.
    void collapse_defects();

    enum class FlipRule { Valence, Angle };

    /// Flips edges where that brings valences towards six, or removes an angle pair above 180 deg.
    void flip_edges(FlipRule rule);

    /// Size: towards the centroid of a vertex' triangles, weighted so that the sizes hold. Shape:
    /// towards the mean of the places that would make each of its triangles equilateral.
    enum class RelaxRule { Size, Shape };

    /// Moves every vertex along the surface by the rule; vertices of rims along their rim.
    void relax(RelaxRule rule);

    /// Raises the mean quality by flips and moves of single vertices.
    void polish();

    /// Works on the triangles that are worse than `quality` (the smaller of 1 - equiangle skewness
    /// and radius ratio) or of another size than a neighbour: flips, moves of single vertices,
    /// collapses.
    /// \return the worst that is left
    double improve_worst(double quality);

    /// Lifts the wall's vertices by the mean height of the source over the middles of their edges.
    /// Flat triangles between vertices on a convex wall cut its volume short, 1.4 % in a tube with
    /// 18 edges around; the mean of a quadratic over a triangle is that of its edges' middles, so
    /// this gives it back. Last step: relaxing would undo it.
    void keep_volume();

    [[nodiscard]] const EditMesh& mesh() const { return mesh_; }

    /// The remeshed surface with the source's patches; attributes are not set.
    [[nodiscard]] Surface result() const;

private:
    struct VertexKind {
        int features = 0;            ///< feature edges at the vertex: 0 inside a patch, 2 on a rim
        std::uint32_t p = 0, q = 0;  ///< the patches it lies in; on rims both
    };

    using HalfEdge = EditMesh::HalfEdge;

    [[nodiscard]] VertexKind kind_of(VertexId v) const;
    [[nodiscard]] bool is_hub(VertexId v) const;
    [[nodiscard]] TargetPlace place_for(VertexId v, const VertexKind& kind, const Vec3& x) const;

    [[nodiscard]] double wanted(VertexId a, VertexId b) const {
        return 0.5 * (size_[a] + size_[b]);
    }

    [[nodiscard]] double length(HalfEdge h) const {
        return (mesh_.points[mesh_.origin(h)] - mesh_.points[mesh_.target(h)]).norm();
    }

    [[nodiscard]] bool is_long(HalfEdge h, double limit) const;
    [[nodiscard]] bool may_collapse(HalfEdge h, double limit);
    [[nodiscard]] double longest_share() const;  ///< of all edges, in wanted lengths
    void split_edges_above(double limit);
    void count_valences();
    [[nodiscard]] int collapse_valence_excess(HalfEdge h) const;
    [[nodiscard]] bool flip_keeps_shape(HalfEdge h) const;
    [[nodiscard]] bool flip_helps(HalfEdge h, FlipRule rule) const;
    [[nodiscard]] int flip_valence_excess(HalfEdge h) const;
    [[nodiscard]] Vec3 normal_at(VertexId v) const;
    [[nodiscard]] Vec3 relaxed_position(VertexId v, const VertexKind& kind, RelaxRule rule) const;
    [[nodiscard]] Vec3 middle_on_rim(VertexId v) const;
    [[nodiscard]] Vec3 centroid_around(VertexId v) const;
    [[nodiscard]] Vec3 shapely_position(VertexId v) const;
    [[nodiscard]] bool move_keeps_shape(VertexId v, const Vec3& x) const;
    void move(VertexId v, const TargetPlace& place);

    /// Moves a vertex to the best of some places around it that `score` (vertex, place) rates
    /// higher than where it is.
    template <class Score>
    bool try_places(VertexId v, double first_step, double last_step, const Score& score);

    /// Sum of the edge lengths of triangle t if v were at x [mm].
    [[nodiscard]] double edges_around(TriangleId t, VertexId v, const Vec3& x) const;
    /// Below 0.5 where the triangles on both sides of h differ too much in size, if v were at x.
    [[nodiscard]] double evenness_across(HalfEdge h, VertexId v, const Vec3& x) const;
    /// At most 1; below 0.5 if t is ill-shaped or of another size than a neighbour.
    [[nodiscard]] double quality_of(TriangleId t) const;
    [[nodiscard]] double shape_around(VertexId v, const Vec3& x) const;
    [[nodiscard]] double worst_around(VertexId v, const Vec3& x) const;
    bool improve_by_flips(TriangleId t);
    bool improve_by_moves(VertexId v);
    bool improve_by_collapses(TriangleId t);

    RemeshTarget target_;
    EditMesh mesh_;
    std::vector<Patch> patches_;
    std::vector<double> size_;      ///< by vertex [mm]
    std::vector<TriangleId> near_;  ///< by vertex
    std::vector<int> valence_;      ///< by vertex, where a step counts them
};

}  // namespace vesselbench
