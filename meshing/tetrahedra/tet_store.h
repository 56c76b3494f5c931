#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshing/volume_mesh.h"

namespace vesselbench {

/// Tetrahedra that are being changed: each vertex knows its cells, cells are removed and added.
/// The boundary's triangles stay as they are.
class TetStore {
public:
    using CellId = std::uint32_t;

    explicit TetStore(const VolumeMesh& mesh);

    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }

    [[nodiscard]] bool alive(CellId cell) const { return alive_[cell] != 0; }

    [[nodiscard]] const Tetrahedron& cell(CellId cell) const { return cells_[cell]; }

    [[nodiscard]] const std::vector<CellId>& star(VertexId v) const { return stars_[v]; }

    [[nodiscard]] bool on_boundary(VertexId v) const { return on_boundary_[v] != 0; }

    /// The vertices around the edge a-b, so that (a, b, r[i], r[i + 1]) is a positive cell; empty
    /// if the edge lies on the boundary or there are more than `largest` of them.
    [[nodiscard]] std::vector<VertexId> ring(VertexId a, VertexId b, std::size_t largest) const;

    /// The cells at the edge a-b.
    [[nodiscard]] std::vector<CellId> cells_at(VertexId a, VertexId b) const;

    /// The cell behind the face opposite to corner `corner`, unless that is at the boundary.
    [[nodiscard]] std::optional<CellId> behind(CellId cell, int corner) const;

    void replace(const std::vector<CellId>& old, const std::vector<Tetrahedron>& fresh);

    /// The living cells, in order.
    [[nodiscard]] std::vector<Tetrahedron> cells() const;

    Positions points;  ///< [mm]

private:
    void remove(CellId cell);
    void add(const Tetrahedron& cell);

    std::vector<Tetrahedron> cells_;
    std::vector<std::uint8_t> alive_;
    std::vector<CellId> free_;
    std::vector<std::vector<CellId>> stars_;
    std::vector<std::uint8_t> on_boundary_;
};

}  // namespace vesselbench
