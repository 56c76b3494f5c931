#include "meshing/tetrahedra/point_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <tbb/parallel_sort.h>

#include "geometry/kernel/space_order.h"

namespace vesselbench {

VolumeMesh in_space_order(const VolumeMesh& mesh) {
    const std::vector<VertexId> order = space_order(mesh.points);
    std::vector<VertexId> number(order.size());
    VolumeMesh sorted;
    sorted.points.reserve(order.size());
    for (VertexId i = 0; i < order.size(); ++i) {
        number[order[i]] = i;
        sorted.points.push_back(mesh.points[order[i]]);
    }
    std::vector<std::pair<VertexId, std::uint32_t>> cells(mesh.tetrahedra.size());
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
        const auto& [p, q, r, s] = mesh.tetrahedra[c];
        cells[c] = {std::min({number[p], number[q], number[r], number[s]}), c};
    }
    tbb::parallel_sort(cells.begin(), cells.end());
    sorted.tetrahedra.reserve(cells.size());
    for (const auto& [lowest, c] : cells) {
        const auto& [p, q, r, s] = mesh.tetrahedra[c];
        sorted.tetrahedra.push_back({number[p], number[q], number[r], number[s]});
    }
    for (const auto& [a, b, c] : mesh.boundary)
        sorted.boundary.push_back({number[a], number[b], number[c]});
    sorted.boundary_patches = mesh.boundary_patches;
    sorted.patches = mesh.patches;
    return sorted;
}

}  // namespace vesselbench
