#include "geometry/vessel/centerlines/thinning.h"

#include <array>
#include <bit>
#include <queue>
#include <utility>

namespace vesselbench {
namespace {

constexpr int kCentre = 13;

struct BlockMasks {
    std::array<std::uint32_t, 27> near26{};  ///< 26-neighbours of each cell within the block
    std::array<std::uint32_t, 27> near6{};   ///< 6-neighbours of each cell within the block
    std::uint32_t faces = 0;                 ///< 6-neighbours of the centre
    std::uint32_t within18 = 0;              ///< 18-neighbours of the centre
};

constexpr int distance_of(int a, int b) {
    return a > b ? a - b : b - a;
}

constexpr BlockMasks make_masks() {
    BlockMasks m;
    for (int a = 0; a < 27; ++a) {
        const int ai = a % 3, aj = a / 3 % 3, ak = a / 9;
        for (int b = 0; b < 27; ++b) {
            const int di = distance_of(ai, b % 3);
            const int dj = distance_of(aj, b / 3 % 3);
            const int dk = distance_of(ak, b / 9);
            const bool adjacent = di <= 1 && dj <= 1 && dk <= 1;
            const auto bit = std::uint32_t{1} << b;
            if (!adjacent || a == b) continue;
            if (b != kCentre) m.near26[static_cast<std::size_t>(a)] |= bit;
            if (di + dj + dk == 1 && b != kCentre) m.near6[static_cast<std::size_t>(a)] |= bit;
            if (a == kCentre && di + dj + dk == 1) m.faces |= bit;
            if (a == kCentre && di + dj + dk <= 2) m.within18 |= bit;
        }
    }
    return m;
}

constexpr BlockMasks kMasks = make_masks();

/// All cells of `set` that are connected to `seed`.
std::uint32_t flood(std::uint32_t seed, std::uint32_t set,
                    const std::array<std::uint32_t, 27>& near) {
    std::uint32_t reached = seed;
    std::uint32_t front = seed;
    while (front != 0) {
        const int cell = std::countr_zero(front);
        front &= front - 1;
        const std::uint32_t fresh = near[static_cast<std::size_t>(cell)] & set & ~reached;
        reached |= fresh;
        front |= fresh;
    }
    return reached;
}

std::uint32_t neighbourhood_of(const std::vector<std::uint8_t>& object, VoxelId v,
                               const std::array<int, 26>& offsets) {
    std::uint32_t bits = 0;
    for (int n = 0; n < 26; ++n) {
        const auto w =
            static_cast<VoxelId>(static_cast<int>(v) + offsets[static_cast<std::size_t>(n)]);
        const int cell = n < kCentre ? n : n + 1;
        bits |= static_cast<std::uint32_t>(object[w]) << cell;
    }
    return bits;
}

}  // namespace

bool is_simple(std::uint32_t neighbourhood) {
    const std::uint32_t all = (std::uint32_t{1} << 27) - 1;
    const std::uint32_t object = neighbourhood & all & ~(std::uint32_t{1} << kCentre);
    if (object == 0) return false;
    const std::uint32_t seed = object & (~object + 1);
    if (flood(seed, object, kMasks.near26) != object) return false;
    const std::uint32_t background = ~object & kMasks.within18;
    const std::uint32_t at_faces = background & kMasks.faces;
    if (at_faces == 0) return false;
    const std::uint32_t first = at_faces & (~at_faces + 1);
    return (at_faces & ~flood(first, background, kMasks.near6)) == 0;
}

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
        if ((~neighbourhood_of(object, v, offsets) & kMasks.faces) != 0) enqueue(v);
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
