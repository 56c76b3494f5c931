#include "geometry/vessel/centerlines/thinning.h"

#include <array>
#include <queue>
#include <utility>

#include "geometry/kernel/simple_point.h"

namespace vesselbench {
namespace {

/// Of a block of 3 x 3 x 3.
constexpr int kCentre = 13;

NeighbourBits neighbourhood_of(const std::vector<std::uint8_t>& object, VoxelId v,
                               const std::array<int, 26>& offsets) {
    NeighbourBits bits = 0;
    for (int n = 0; n < 26; ++n) {
        const auto w =
            static_cast<VoxelId>(static_cast<int>(v) + offsets[static_cast<std::size_t>(n)]);
        const int cell = n < kCentre ? n : n + 1;
        bits |= static_cast<NeighbourBits>(object[w]) << cell;
    }
    return bits;
}

}  // namespace

std::vector<VoxelId> thin(const LumenGrid& grid, std::span<const VoxelId> voxels,
                          std::span<const VoxelId> anchors, const Progress& progress) {
    constexpr std::uint8_t kAnchor = 1;
    constexpr std::uint8_t kQueued = 2;
    const auto offsets = grid.neighbour_offsets();
    std::vector<std::uint8_t> object(grid.lumen.size(), 0);
    for (const VoxelId v : voxels) object[v] = 1;
    std::vector<std::uint8_t> flags(grid.lumen.size(), 0);
    for (const VoxelId v : anchors) flags[v] = kAnchor;

    using Item = std::pair<float, VoxelId>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const auto enqueue = [&](VoxelId v) {
        if (flags[v] != 0) return;
        flags[v] = kQueued;
        queue.emplace(grid.depth[v], v);
    };
    for (const VoxelId v : voxels) {
        if ((~neighbourhood_of(object, v, offsets) & kFaceNeighbours) != 0) enqueue(v);
    }
    for (std::size_t step = 0; !queue.empty(); ++step) {
        if (step % 65536 == 0) progress.check_cancelled();
        const VoxelId v = queue.top().second;
        queue.pop();
        flags[v] = 0;
        if (!is_simple(neighbourhood_of(object, v, offsets))) continue;
        object[v] = 0;
        for (const int o : offsets) {
            const auto w = static_cast<VoxelId>(static_cast<int>(v) + o);
            if (object[w]) enqueue(w);
        }
    }
    std::vector<VoxelId> curve;
    for (const VoxelId v : voxels) {
        if (object[v]) curve.push_back(v);
    }
    return curve;
}

}  // namespace vesselbench
