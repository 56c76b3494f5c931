#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// A tetrahedral mesh under modification: each vertex knows its cells; cells are removed and added.
/// The boundary triangles do not change.
///
/// Several threads may modify it, each within its own group of vertices: a thread may replace cells
/// whose corners are all in its group, and use the slots of one list that no other thread uses.
class TetStore {
public:
    using CellId = std::uint32_t;

    static constexpr std::size_t kLargestRing = 12;  ///< of find_ring

    explicit TetStore(const VolumeMesh& mesh);

    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }

    [[nodiscard]] bool alive(CellId cell) const { return alive_[cell] != 0; }

    [[nodiscard]] const Tetrahedron& cell(CellId cell) const { return cells_[cell]; }

    [[nodiscard]] const std::vector<CellId>& star(VertexId v) const { return stars_[v]; }

    [[nodiscard]] bool on_boundary(VertexId v) const { return on_boundary_[v] != 0; }

    /// The cells around an edge a-b and the vertices between them, ordered so that (a, b, r[i], r[i
    /// + 1]) is a positive cell.
    struct Ring {
        std::vector<CellId> cells;
        std::vector<VertexId> vertices;
    };

    /// \return false if the edge is on the boundary or has more than `largest` or kLargestRing
    /// cells
    [[nodiscard]] bool find_ring(VertexId a, VertexId b, std::size_t largest, Ring& ring) const;

    /// The cell behind the face opposite to corner `corner`, unless that face is on the boundary.
    [[nodiscard]] std::optional<CellId> behind(CellId cell, int corner) const;

    /// Free slots for new cells.
    using Slots = std::vector<CellId>;

    /// Adds free slots to a list until it has `count`.
    void provide(Slots& slots, std::size_t count);

    /// Replaces cells, if there are enough slots for the new ones; freed slots go to the list.
    /// \param added receives the new cells
    [[nodiscard]] bool replace(const std::vector<CellId>& old,
                               const std::vector<Tetrahedron>& fresh, Slots& slots,
                               std::vector<CellId>& added);

    /// The live cells, in order.
    [[nodiscard]] std::vector<Tetrahedron> cells() const;

    Positions points;  ///< [mm]

private:
    void fill_stars();
    void remove(CellId cell);

    std::vector<Tetrahedron> cells_;
    std::vector<std::uint8_t> alive_;
    std::vector<std::vector<CellId>> stars_;
    std::vector<std::uint8_t> on_boundary_;
};

}  // namespace vesselbench
