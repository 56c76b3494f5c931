#include "meshing/tetrahedra/cell_order.h"

#include <utility>

namespace vesselbench {

namespace {

constexpr std::uint32_t kNone = MeshFace::kOutside;

// Cells in breadth-first order from `start`; unreachable cells follow, starting from the lowest
// one.
std::vector<std::uint32_t> breadth_first(const CellNeighbours& neighbours, std::uint32_t start) {
    std::vector<std::uint32_t> order;
    order.reserve(neighbours.size());
    std::vector<std::uint8_t> seen(neighbours.size(), 0);
    std::uint32_t next_start = 0;
    const auto visit = [&](std::uint32_t cell) {
        if (seen[cell] != 0) return;
        seen[cell] = 1;
        order.push_back(cell);
    };
    if (!neighbours.empty()) visit(start);
    for (std::size_t done = 0; done < neighbours.size(); ++done) {
        while (done == order.size()) visit(next_start++);
        for (const std::uint32_t other : neighbours[order[done]])
            if (other != kNone) visit(other);
    }
    return order;
}

}  // namespace

VolumeMesh in_cell_order(VolumeMesh mesh, CellNeighbours& neighbours) {
    const CellNeighbours before = cell_neighbours(mesh);
    neighbours.clear();
    if (before.empty()) return mesh;
    // The last cell reached lies at one end of the vessel: a good start for narrow fronts.
    const auto order = breadth_first(before, breadth_first(before, 0).back());
    std::vector<std::uint32_t> number(order.size());
    for (std::uint32_t cell = 0; cell < order.size(); ++cell) number[order[cell]] = cell;
    std::vector<Tetrahedron> sorted;
    sorted.reserve(order.size());
    neighbours.reserve(order.size());
    for (const std::uint32_t cell : order) {
        sorted.push_back(mesh.tetrahedra[cell]);
        neighbours.push_back(before[cell]);
        for (std::uint32_t& other : neighbours.back())
            if (other != kNone) other = number[other];
    }
    mesh.tetrahedra = std::move(sorted);
    return mesh;
}

}  // namespace vesselbench
