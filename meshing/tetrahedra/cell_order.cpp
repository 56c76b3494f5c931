#include "meshing/tetrahedra/cell_order.h"

#include <algorithm>
#include <array>

#include "meshing/tetrahedra/quality.h"

namespace vesselbench {

namespace {

using Neighbours = std::vector<std::array<std::uint32_t, 4>>;

constexpr std::uint32_t kNone = MeshFace::kOutside;

Neighbours cell_neighbours(const VolumeMesh& mesh) {
    Neighbours neighbours(mesh.tetrahedra.size(), {kNone, kNone, kNone, kNone});
    std::vector<std::uint8_t> filled(mesh.tetrahedra.size(), 0);
    for (const MeshFace& face : mesh_faces(mesh)) {
        if (face.neighbour == kNone) continue;
        neighbours[face.owner][filled[face.owner]++] = face.neighbour;
        neighbours[face.neighbour][filled[face.neighbour]++] = face.owner;
    }
    return neighbours;
}

// Cells in breadth-first order from `start`; unreachable cells follow, starting from the lowest
// one.
std::vector<std::uint32_t> breadth_first(const Neighbours& neighbours, std::uint32_t start) {
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

VolumeMesh in_cell_order(VolumeMesh mesh) {
    const Neighbours neighbours = cell_neighbours(mesh);
    if (neighbours.empty()) return mesh;
    // The last cell reached lies at one end of the vessel: a good start for narrow fronts.
    const auto order = breadth_first(neighbours, breadth_first(neighbours, 0).back());
    std::vector<Tetrahedron> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t cell : order) sorted.push_back(mesh.tetrahedra[cell]);
    mesh.tetrahedra = std::move(sorted);
    return mesh;
}

}  // namespace vesselbench
