#include "geometry/image/voxel_topology.h"

#include <array>
#include <atomic>

#include <tbb/parallel_for.h>

namespace vesselbench {

namespace {

using Size = std::array<int, 3>;

std::vector<std::array<int, 3>> neighbour_steps(Neighbourhood neighbourhood) {
    std::vector<std::array<int, 3>> steps;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int away = std::abs(i) + std::abs(j) + std::abs(k);
                if (away > 0 && (neighbourhood == Neighbourhood::All || away == 1))
                    steps.push_back({i, j, k});
            }
    return steps;
}

/// Labels components by flooding; `counts(v)` returns whether voxel v belongs to the set.
template <class Counts>
VoxelComponents flood(const Image& grid, const Counts& counts, Neighbourhood neighbourhood) {
    const auto steps = neighbour_steps(neighbourhood);
    VoxelComponents found;
    found.labels.assign(grid.voxel_count(), 0);
    std::vector<std::array<int, 3>> open;
    const auto visit = [&](int i, int j, int k) {
        if (i < 0 || j < 0 || k < 0 || i >= grid.size[0] || j >= grid.size[1] || k >= grid.size[2])
            return;
        const std::size_t v = grid.offset(i, j, k);
        if (found.labels[v] != 0 || !counts(v)) return;
        found.labels[v] = static_cast<std::int32_t>(found.sizes.size());
        ++found.sizes.back();
        open.push_back({i, j, k});
    };
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                const std::size_t v = grid.offset(i, j, k);
                if (found.labels[v] != 0 || !counts(v)) continue;
                found.sizes.push_back(0);
                visit(i, j, k);
                while (!open.empty()) {
                    const auto [x, y, z] = open.back();
                    open.pop_back();
                    for (const auto& [dx, dy, dz] : steps) visit(x + dx, y + dy, z + dz);
                }
            }
    return found;
}

/// Background components that do not reach the image's border.
std::int64_t cavities_of(const Image& image, float threshold) {
    const auto background = flood(
        image, [&](std::size_t v) { return (*image.voxels)[v] < threshold; }, Neighbourhood::Faces);
    std::vector<std::uint8_t> open(background.sizes.size() + 1, 0);
    const auto [ni, nj, nk] = image.size;
    for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
            for (int i = 0; i < ni; ++i)
                if (i == 0 || j == 0 || k == 0 || i == ni - 1 || j == nj - 1 || k == nk - 1)
                    open[static_cast<std::size_t>(background.labels[image.offset(i, j, k)])] = 1;
    std::int64_t closed = 0;
    for (std::size_t c = 1; c < open.size(); ++c) closed += open[c] ? 0 : 1;
    return closed;
}

/// Cells of the union of boxes that start at lattice corner (i, j, k): +1 for its vertex, -1 for
/// each of three edges, +1 for each of three faces, -1 for the box.
int cells_at(const Image& image, float threshold, int i, int j, int k) {
    const auto in = [&](int di, int dj, int dk) {
        const int x = i - di, y = j - dj, z = k - dk;
        return x >= 0 && y >= 0 && z >= 0 && x < image.size[0] && y < image.size[1] &&
               z < image.size[2] && image.at(x, y, z) >= threshold;
    };
    // n[di][dj][dk]: the box at (i - di, j - dj, k - dk), which touches the corner.
    bool n[2][2][2];
    bool any = false;
    for (int c = 0; c < 8; ++c) any |= n[c & 1][c >> 1 & 1][c >> 2] = in(c & 1, c >> 1 & 1, c >> 2);
    if (!any) return 0;
    int sum = 1;
    sum -= n[0][0][0] || n[0][1][0] || n[0][0][1] || n[0][1][1];  // edge along i
    sum -= n[0][0][0] || n[1][0][0] || n[0][0][1] || n[1][0][1];  // edge along j
    sum -= n[0][0][0] || n[1][0][0] || n[0][1][0] || n[1][1][0];  // edge along k
    sum += n[0][0][0] || n[0][0][1];                              // face across k
    sum += n[0][0][0] || n[0][1][0];                              // face across j
    sum += n[0][0][0] || n[1][0][0];                              // face across i
    sum -= n[0][0][0];
    return sum;
}

}  // namespace

VoxelComponents voxel_components(const Image& image, double threshold,
                                 Neighbourhood neighbourhood) {
    const auto limit = static_cast<float>(threshold);
    return flood(
        image, [&](std::size_t v) { return (*image.voxels)[v] >= limit; }, neighbourhood);
}

VoxelTopology voxel_topology(const Image& image, double threshold) {
    const auto limit = static_cast<float>(threshold);
    VoxelTopology topology;
    topology.components = static_cast<std::int64_t>(
        voxel_components(image, threshold, Neighbourhood::All).sizes.size());
    topology.cavities = cavities_of(image, limit);
    std::atomic<std::int64_t> euler = 0;  // integers: the order of summation does not matter
    tbb::parallel_for(0, image.size[2] + 1, [&](int k) {
        std::int64_t sum = 0;
        for (int j = 0; j <= image.size[1]; ++j)
            for (int i = 0; i <= image.size[0]; ++i) sum += cells_at(image, limit, i, j, k);
        euler += sum;
    });
    topology.euler = euler;
    return topology;
}

}  // namespace vesselbench
