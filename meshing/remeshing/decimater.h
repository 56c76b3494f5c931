#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/remeshing/edit_mesh.h"
#include "meshing/remeshing/error_bound.h"
#include "meshing/remeshing/quadric.h"

namespace vesselbench {

/// A surface under decimation: its mesh, a quadric for each vertex, and the queue of edges.
class Decimater {
public:
    /// \param weights as for decimate()
    /// \param locked 1 at vertices to keep, #V; empty: none
    /// \param bound may be null
    Decimater(const Surface& source, std::span<const double> weights,
              std::span<const std::uint8_t> locked, ErrorBound* bound);

    /// Collapses edges until at most `triangles` are left, or no edge may be collapsed.
    void run(std::size_t triangles, const Progress& progress);

    [[nodiscard]] std::size_t triangles() const { return triangles_; }

    /// Vertices of weight 0 that were removed or moved.
    [[nodiscard]] std::size_t kept_vertices_lost() const { return kept_lost_; }

    /// The decimated surface with the source's patches; attributes are not set.
    [[nodiscard]] Surface result(const std::vector<Patch>& patches) const;

private:
    using HalfEdge = EditMesh::HalfEdge;

    /// Merges the origin of `edge` into its target, which moves to `place`.
    struct Collapse {
        HalfEdge edge = EditMesh::kNone;
        Vec3 place = Vec3::Zero();
        double cost = 0.0;
    };

    /// An edge in the queue, valid while its ends have these stamps.
    struct Entry {
        double cost = 0.0;
        HalfEdge edge = EditMesh::kNone;
        std::uint32_t origin_stamp = 0, target_stamp = 0;

        /// For a queue with the first edge on top.
        bool operator<(const Entry& other) const;
    };

    void add_quadrics(const Surface& source, std::span<const double> weights);
    void add_border(HalfEdge h, double importance);
    void find_borders();
    void push_all(const Progress& progress);
    void push(HalfEdge h);
    void push_around(VertexId v);
    [[nodiscard]] bool is_current(const Entry& entry) const;
    [[nodiscard]] std::optional<Collapse> best_collapse(HalfEdge h);
    [[nodiscard]] Vec3 place_inside(VertexId a, VertexId b, const Quadric& sum) const;
    [[nodiscard]] double penalty(const Collapse& collapse) const;
    [[nodiscard]] double full_cost(const Collapse& collapse) const;
    [[nodiscard]] Vec3 facing(TriangleId t, VertexId v) const;
    [[nodiscard]] bool folds(const Collapse& collapse) const;
    [[nodiscard]] bool work_off_queue(std::size_t triangles, const Progress& progress);
    [[nodiscard]] bool stays_near(const Collapse& collapse);
    bool try_collapse(const Entry& entry);
    void lose(VertexId v);
    void commit(const Collapse& collapse);

    EditMesh mesh_;
    std::vector<Quadric> quadrics_;      ///< by vertex
    std::vector<double> areas_;          ///< merged into one vertex [mm^2], by vertex
    std::vector<std::uint8_t> keep_;     ///< 1 if a weight of the merged vertices is 0
    std::vector<std::uint8_t> intact_;   ///< 1 if the weight is 0 and the vertex unchanged
    std::vector<std::uint8_t> locked_;   ///< by vertex
    std::vector<std::uint8_t> border_;   ///< 1 at vertices on borders of patches, by vertex
    std::vector<std::uint32_t> stamps_;  ///< number of changes of a vertex's quadric
    std::priority_queue<Entry> queue_;
    ErrorBound* bound_ = nullptr;
    Vec3 centre_ = Vec3::Zero();  ///< of the points, which are stored relative to it
    std::size_t triangles_ = 0;
    std::size_t start_triangles_ = 0;
    std::size_t kept_lost_ = 0;
};

}  // namespace vesselbench
