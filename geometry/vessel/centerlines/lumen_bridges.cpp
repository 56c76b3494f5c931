#include "geometry/vessel/centerlines/lumen_bridges.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/kernel/disjoint_sets.h"

namespace vesselbench {
namespace {

constexpr std::size_t kSmallestPart = 3;  ///< voxels: fewer say nothing of a vessel
constexpr std::size_t kMostParts = 500;
constexpr int kLongestBridge = 16;               ///< steps
constexpr std::size_t kMostVisited = 50'000;     ///< voxels in all: seconds
constexpr std::size_t kMostVisitedEach = 2'000;  ///< voxels around one part

class Bridges {
public:
    Bridges(LumenGrid& grid, const SurfaceDistance& wall, const Progress& cancel)
        : grid_(grid),
          wall_(wall),
          cancel_(cancel),
          offsets_(grid.neighbour_offsets()),
          lengths_(grid.neighbour_lengths()),
          parts_(lumen_parts(grid, cancel)) {}

    void build() {
        const auto& members = parts_.members;
        if (members.size() < 2) return;
        DisjointSets joined(members.size());
        std::vector<std::uint32_t> order(members.size());
        std::iota(order.begin(), order.end(), std::uint32_t{0});
        std::ranges::stable_sort(order, std::greater{},
                                 [&](std::uint32_t p) { return members[p].size(); });
        const std::size_t most = std::min(order.size(), kMostParts);
        for (std::size_t i = 1; i < most && visited_ < kMostVisited; ++i) {
            const std::uint32_t part = order[i];
            if (members[part].size() < kSmallestPart) break;
            if (joined.root(part) == joined.root(order.front())) continue;
            if (const auto other = bridge_from(part, joined)) joined.join(part, *other);
        }
        std::ranges::sort(grid_.voxels);
    }

private:
    using Part = std::uint32_t;

    [[nodiscard]] VoxelId neighbour(VoxelId v, std::size_t n) const {
        return static_cast<VoxelId>(static_cast<int>(v) + offsets_[n]);
    }

    [[nodiscard]] bool is_open(VoxelId v, std::size_t n) const {
        const Vec3 from = grid_.centre(v);
        const Vec3 way = grid_.centre(neighbour(v, n)) - from;
        return !wall_.first_hit(from, way, static_cast<double>(lengths_[n]));
    }

    /// False for a voxel outside the grid's border, or beside one beyond a wall.
    [[nodiscard]] bool may_join(VoxelId v) const {
        const auto at = grid_.index(v);
        for (int k = 0; k < 3; ++k)
            if (at[k] < 1 || at[k] + 1 >= grid_.size[k]) return false;
        for (std::size_t n = 0; n < offsets_.size(); ++n)
            if (grid_.lumen[neighbour(v, n)] != 0 && !is_open(v, n)) return false;
        return true;
    }

    /// The nearest other part, which is then joined by voxels; empty if none is within reach.
    std::optional<Part> bridge_from(Part part, DisjointSets& joined) {
        std::unordered_map<VoxelId, VoxelId> from;  // of visited voxels, those they were reached by
        std::vector<VoxelId> shell = parts_.members[part];
        const std::size_t most = visited_ + kMostVisitedEach;
        for (int step = 0; step < kLongestBridge && !shell.empty(); ++step) {
            std::vector<VoxelId> next;
            for (const VoxelId v : shell) {
                for (std::size_t n = 0; n < offsets_.size(); ++n) {
                    const VoxelId w = neighbour(v, n);
                    const bool lumen = grid_.lumen[w] != 0;
                    if (lumen && joined.root(parts_.of_voxel[w]) == joined.root(part)) continue;
                    if (from.contains(w) || !is_open(v, n)) continue;
                    if (lumen && step == 0) continue;  // a neighbour: they are one part
                    if (lumen) return take(v, w, part, from);
                    if (!may_join(w)) continue;
                    from.emplace(w, v);
                    next.push_back(w);
                    if (++visited_ > most) return std::nullopt;
                }
                cancel_.check_cancelled();
            }
            shell = std::move(next);
        }
        return std::nullopt;
    }

    /// Adds the voxels from one before the other part back to the own one.
    Part take(VoxelId last, VoxelId other, Part part,
              const std::unordered_map<VoxelId, VoxelId>& from) {
        for (VoxelId v = last; grid_.lumen[v] == 0; v = from.at(v)) {
            grid_.lumen[v] = 1;
            parts_.of_voxel[v] = part;
            grid_.voxels.push_back(v);
        }
        return parts_.of_voxel[other];
    }

    LumenGrid& grid_;
    const SurfaceDistance& wall_;
    const Progress& cancel_;
    std::array<int, 26> offsets_;
    std::array<float, 26> lengths_;
    LumenParts parts_;  ///< their members are those before bridges were built
    std::size_t visited_ = 0;
};

}  // namespace

void bridge_parts(LumenGrid& grid, const SurfaceDistance& wall, const Progress& cancel) {
    Bridges(grid, wall, cancel).build();
}

}  // namespace vesselbench
