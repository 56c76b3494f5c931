#include "meshing/tetrahedra/tet_store.h"

#include <algorithm>

namespace vesselbench {

namespace {

bool has(const Tetrahedron& cell, VertexId v) {
    return cell[0] == v || cell[1] == v || cell[2] == v || cell[3] == v;
}

// The other two corners p, q of a positive cell, ordered so that (a, b, p, q) is positive too.
std::array<VertexId, 2> others(const Tetrahedron& cell, VertexId a, VertexId b) {
    const int i = static_cast<int>(std::find(cell.begin(), cell.end(), a) - cell.begin());
    const int j = static_cast<int>(std::find(cell.begin(), cell.end(), b) - cell.begin());
    std::array<int, 2> rest;
    int n = 0;
    for (int k = 0; k < 4; ++k)
        if (k != i && k != j) rest[n++] = k;
    int inversions = (i > j) + (i > rest[0]) + (i > rest[1]) + (j > rest[0]) + (j > rest[1]);
    if (inversions % 2 != 0) std::swap(rest[0], rest[1]);
    return {cell[rest[0]], cell[rest[1]]};
}

}  // namespace

TetStore::TetStore(const VolumeMesh& mesh)
    : points(mesh.points),
      cells_(mesh.tetrahedra),
      alive_(mesh.tetrahedra.size(), 1),
      stars_(mesh.points.size()),
      on_boundary_(mesh.points.size(), 0) {
    fill_stars();
    for (const Triangle& triangle : mesh.boundary)
        for (const VertexId v : triangle) on_boundary_[v] = 1;
}

void TetStore::fill_stars() {
    constexpr std::uint32_t kSpare = 8;  // exchanges let stars grow a little
    std::vector<std::uint32_t> counts(points.size(), 0);
    for (const Tetrahedron& cell : cells_)
        for (const VertexId v : cell) ++counts[v];
    for (std::size_t v = 0; v < stars_.size(); ++v)
        if (counts[v] > 0) stars_[v].reserve(counts[v] + kSpare);
    for (CellId cell = 0; cell < cells_.size(); ++cell)
        for (const VertexId v : cells_[cell]) stars_[v].push_back(cell);
}

bool TetStore::find_ring(VertexId a, VertexId b, std::size_t largest, Ring& ring) const {
    ring.cells.clear();
    ring.vertices.clear();
    for (const CellId cell : stars_[a])
        if (has(cells_[cell], b)) ring.cells.push_back(cell);
    const std::size_t count = ring.cells.size();
    if (count < 3 || count > largest || count > kLargestRing) return false;
    std::array<std::array<VertexId, 2>, kLargestRing> links;
    for (std::size_t i = 0; i < count; ++i) links[i] = others(cells_[ring.cells[i]], a, b);
    ring.vertices.push_back(links[0][0]);
    for (VertexId next = links[0][1]; next != ring.vertices[0];) {
        ring.vertices.push_back(next);
        const auto end = links.begin() + static_cast<std::ptrdiff_t>(count);
        const auto link =
            std::find_if(links.begin(), end, [&](const auto& l) { return l[0] == next; });
        if (link == end || ring.vertices.size() > count) return false;
        next = (*link)[1];
    }
    return ring.vertices.size() == count;
}

std::optional<TetStore::CellId> TetStore::behind(CellId cell, int corner) const {
    const Triangle face = faces_of(cells_[cell])[corner];
    for (const CellId other : stars_[face[0]])
        if (other != cell && has(cells_[other], face[1]) && has(cells_[other], face[2]))
            return other;
    return std::nullopt;
}

void TetStore::provide(Slots& slots, std::size_t count) {
    while (slots.size() < count) {
        slots.push_back(static_cast<CellId>(cells_.size()));
        cells_.push_back({});
        alive_.push_back(0);
    }
}

bool TetStore::replace(const std::vector<CellId>& old, const std::vector<Tetrahedron>& fresh,
                       Slots& slots, std::vector<CellId>& added) {
    added.clear();
    if (slots.size() + old.size() < fresh.size()) return false;
    for (const CellId cell : old) {
        remove(cell);
        slots.push_back(cell);
    }
    for (const Tetrahedron& cell : fresh) {
        const CellId id = slots.back();
        slots.pop_back();
        cells_[id] = cell;
        alive_[id] = 1;
        for (const VertexId v : cell) stars_[v].push_back(id);
        added.push_back(id);
    }
    return true;
}

void TetStore::remove(CellId cell) {
    alive_[cell] = 0;
    for (const VertexId v : cells_[cell]) std::erase(stars_[v], cell);
}

std::vector<Tetrahedron> TetStore::cells() const {
    std::vector<Tetrahedron> living;
    for (CellId cell = 0; cell < cells_.size(); ++cell)
        if (alive(cell)) living.push_back(cells_[cell]);
    return living;
}

}  // namespace vesselbench
