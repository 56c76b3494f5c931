#pragma once

#include <vector>

#include "meshing/remeshing/remesh_state.h"

namespace vesselbench {

/// The passes of remeshing over a whole surface. What a pass has to do is found, and new places are
/// computed, on all threads; edits are made on one, in an order that follows from the mesh alone,
/// so that the same input gives the same bits for any number of threads. All throw Cancelled.
class Remesher : public RemeshState {
public:
    using RemeshState::RemeshState;

    /// Resulting edges are longer than `sizes` by this factor [-] (observed on tubes and vessels).
    static constexpr double kStretch = 1.07;

    /// Finer meshes are refused: they would only fill the memory.
    static constexpr std::size_t kMostTriangles = 10'000'000;
    /// While it is made: splitting in the first round makes up to eight times the final number.
    static constexpr std::size_t kMostAtOnce = 30'000'000;

    /// Changes the target edge lengths [mm], by vertex of the source: returns all vertices to the
    /// source, and from now on the passes leave alone what is more than three edges away from any
    /// place with a shorter length than before.
    void set_sizes(const std::vector<double>& source_sizes);

    /// From now on the passes leave alone what lies more than some rings away from the vertices
    /// that do not rest.
    /// \param rest by vertex of the mesh; those beyond the end rest
    void rest_beyond(std::vector<std::uint8_t> rest, int rings);

    /// Splits edges longer than `limit` target lengths until there are none.
    /// \throw AlgorithmFailure beyond kMostAtOnce
    void split_long_edges(double limit = kLong);

    /// Collapses edges shorter than 4/5 of the target length if that preserves rims, makes no long
    /// edge and folds nothing over.
    void collapse_short_edges();

    /// Collapses edges of any length if valences do not get farther from six in total: a mesh that
    /// only meets its edge lengths is full of pairs of valence five and seven.
    void collapse_defects();

    enum class FlipRule { Valence, Angle };

    /// Flips edges if that moves valences towards six, or removes an angle pair above 180 deg.
    void flip_edges(FlipRule rule);

    /// Size: towards the centroid of a vertex's triangles, weighted to preserve the sizes. Shape:
    /// towards the mean of the places that would make each of its triangles equilateral.
    enum class RelaxRule { Size, Shape };

    /// Moves every vertex along the surface by the rule; vertices of rims along their rim.
    void relax(RelaxRule rule);

    /// Lifts the wall's vertices by the mean height of the source over the middles of their edges.
    /// Flat triangles between vertices on a convex wall cut its volume short, 1.4 % in a tube with
    /// 18 edges around; the mean of a quadratic over a triangle is that of its edges' middles, so
    /// this restores it. Last step: relaxing would undo it.
    void keep_volume();

private:
    [[nodiscard]] bool is_above(HalfEdge h, double limit) const {
        const double most = limit * wanted(mesh.origin(h), mesh.target(h));
        return (mesh.points[mesh.origin(h)] - mesh.points[mesh.target(h)]).squaredNorm() >
               most * most;
    }

    [[nodiscard]] bool rests(HalfEdge h) const {
        return RemeshState::rests(mesh.origin(h)) && RemeshState::rests(mesh.target(h));
    }

    // The first of an edge's half-edges has these properties, in target lengths.
    [[nodiscard]] bool is_long(HalfEdge h, double limit) const;
    [[nodiscard]] bool is_short(HalfEdge h) const;
    [[nodiscard]] bool is_defect(HalfEdge h) const;
    void check_size() const;
    [[nodiscard]] double longest_share() const;  ///< of all edges, in target lengths
    void split_edges_above(double limit);
    void count_valences();
    [[nodiscard]] int collapse_valence_excess(HalfEdge h) const;
    [[nodiscard]] bool flip_helps(HalfEdge h, FlipRule rule) const;
    [[nodiscard]] int flip_valence_excess(HalfEdge h) const;
    [[nodiscard]] Vec3 relaxed_position(VertexId v, const VertexKind& kind, const Vec3& normal,
                                        RelaxRule rule) const;
    [[nodiscard]] Vec3 middle_on_rim(VertexId v) const;
    [[nodiscard]] Vec3 centroid_around(VertexId v) const;
    [[nodiscard]] Vec3 shapely_position(VertexId v) const;

    std::vector<int> valence_;  ///< by vertex, if a step counts them
};

}  // namespace vesselbench
