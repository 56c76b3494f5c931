#include "geometry/image/voxel_chains.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "geometry/image/voxel_band.h"
#include "geometry/image/voxels.h"
#include "geometry/kernel/simple_point.h"

namespace vesselbench {

namespace {

/// Where the zero set crosses to the voxels beside a chain, as a share of the way. A vessel that
/// leaves a chain is less than two voxels wide. At 0.71 its section would have the area of a
/// voxel's face; smoothing afterwards takes up to two fifths of the width of so few triangles.
constexpr float kChainShare = 0.95f;
constexpr float kSheetShare = 0.5f;
/// A voxel centre outside is at least this far from the surface [halves of the smallest edge].
constexpr float kNearest = 1e-3f;

constexpr std::array<VoxelIndex, 6> kFaces = {
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
/// Each pair of voxels with an edge, then each with a corner in common, from one side.
constexpr std::array<VoxelIndex, 10> kDiagonals = {{{1, 1, 0},
                                                    {1, -1, 0},
                                                    {1, 0, 1},
                                                    {1, 0, -1},
                                                    {0, 1, 1},
                                                    {0, 1, -1},
                                                    {1, 1, 1},
                                                    {1, 1, -1},
                                                    {1, -1, 1},
                                                    {1, -1, -1}}};

VoxelIndex operator+(const VoxelIndex& a, const VoxelIndex& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The voxels of a mask; what lies beyond its border is outside.
class Voxels {
public:
    explicit Voxels(const Image& mask) : mask_(mask), inside_(mask.voxel_count()) {
        for (std::size_t v = 0; v < inside_.size(); ++v)
            inside_[v] = is_inside((*mask.voxels)[v]) ? 1 : 0;
    }

    [[nodiscard]] bool is_there(const VoxelIndex& at) const { return holds(mask_, at); }

    [[nodiscard]] std::size_t offset(const VoxelIndex& at) const {
        return mask_.offset(at[0], at[1], at[2]);
    }

    [[nodiscard]] bool is_in(const VoxelIndex& at) const {
        return is_there(at) && inside_[offset(at)] != 0;
    }

    void add(const VoxelIndex& at) { inside_[offset(at)] = 1; }

    /// In a block of 2 x 2 x 1 or 2 x 2 x 2 voxels inside. \param thick along the third axis, too
    [[nodiscard]] bool is_in_block(const VoxelIndex& at, bool thick) const {
        for (int flat = 0; flat < (thick ? 1 : 3); ++flat)
            for (int corner = 0; corner < 8; ++corner) {
                VoxelIndex side;
                for (int a = 0; a < 3; ++a)
                    side[static_cast<std::size_t>(a)] = (corner >> a) % 2 == 0 ? 1 : -1;
                if (!thick) side[static_cast<std::size_t>(flat)] = 0;
                if (is_whole(at, side)) return true;
            }
        return false;
    }

    [[nodiscard]] bool is_chain(const VoxelIndex& at) const {
        return is_in(at) && !is_in_block(at, false) && connects(at);
    }

    /// Calls visit(index) for the voxels inside.
    template <class Visit>
    void for_each_inside(const Visit& visit) const {
        for (int k = 0; k < mask_.size[2]; ++k)
            for (int j = 0; j < mask_.size[1]; ++j)
                for (int i = 0; i < mask_.size[0]; ++i)
                    if (inside_[mask_.offset(i, j, k)] != 0) visit(VoxelIndex{i, j, k});
    }

    [[nodiscard]] Image taken() const {
        return with_voxels(mask_, {inside_.begin(), inside_.end()});
    }

private:
    /// All voxels of the block from a voxel to its neighbour at `side` are inside.
    [[nodiscard]] bool is_whole(const VoxelIndex& at, const VoxelIndex& side) const {
        for (int corner = 0; corner < 8; ++corner) {
            const VoxelIndex step = {corner % 2 * side[0], corner / 2 % 2 * side[1],
                                     corner / 4 * side[2]};
            if (!is_in(at + step)) return false;
        }
        return true;
    }

    /// The voxels around it fall apart without it.
    [[nodiscard]] bool connects(const VoxelIndex& at) const {
        NeighbourBits around = 0;
        for (int n = 0; n < 27; ++n)
            if (is_in(at + VoxelIndex{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}))
                around |= NeighbourBits{1} << n;
        return connects_parts(around);
    }

    const Image& mask_;
    std::vector<std::uint8_t> inside_;
};

/// Both are connected by faces within a voxel around them.
bool are_joined(const Voxels& voxels, const VoxelIndex& from, const VoxelIndex& to) {
    std::vector<VoxelIndex> reached = {from};
    const auto is_near = [&](const VoxelIndex& at) {
        for (std::size_t a = 0; a < 3; ++a)
            if (at[a] < std::min(from[a], to[a]) - 1 || at[a] > std::max(from[a], to[a]) + 1)
                return false;
        return true;
    };
    for (std::size_t r = 0; r < reached.size(); ++r) {
        if (reached[r] == to) return true;
        for (const VoxelIndex& step : kFaces) {
            const VoxelIndex next = reached[r] + step;
            if (is_near(next) && voxels.is_in(next) && std::ranges::count(reached, next) == 0)
                reached.push_back(next);
        }
    }
    return false;
}

/// The voxels between two that have an edge or a corner in common, on the way with the most voxels
/// inside around it.
std::vector<VoxelIndex> voxels_between(const Voxels& voxels, const VoxelIndex& from,
                                       const VoxelIndex& step) {
    std::vector<std::size_t> axes;
    for (std::size_t a = 0; a < 3; ++a)
        if (step[a] != 0) axes.push_back(a);
    std::vector<VoxelIndex> best;
    int most = -1;
    do {
        std::vector<VoxelIndex> way;
        VoxelIndex at = from;
        int beside = 0;
        for (std::size_t s = 0; s + 1 < axes.size(); ++s) {
            at[axes[s]] += step[axes[s]];
            way.push_back(at);
            for (const VoxelIndex& face : kFaces) beside += voxels.is_in(at + face) ? 1 : 0;
        }
        if (beside <= most) continue;
        most = beside;
        best = std::move(way);
    } while (std::ranges::next_permutation(axes).found);
    return best;
}

/// Of the way to the voxels beside it that are outside; 0: any.
float least_share(const Voxels& voxels, const VoxelIndex& at) {
    if (voxels.is_in_block(at, true)) return 0.0f;
    return voxels.is_in_block(at, false) ? kSheetShare : kChainShare;
}

}  // namespace

JoinedMask joined_chains(const Image& mask) {
    Voxels voxels(mask);
    JoinedMask joined;
    for (const VoxelIndex& step : kDiagonals) {
        std::vector<VoxelIndex> added;
        voxels.for_each_inside([&](const VoxelIndex& at) {
            const VoxelIndex to = at + step;
            if (!voxels.is_in(to) || are_joined(voxels, at, to) ||
                !(voxels.is_chain(at) || voxels.is_chain(to)))
                return;
            for (const VoxelIndex& between : voxels_between(voxels, at, step))
                added.push_back(between);
        });
        for (const VoxelIndex& between : added)
            if (!voxels.is_in(between)) {
                voxels.add(between);
                ++joined.added;
            }
    }
    joined.mask = joined.added > 0 ? voxels.taken() : mask;
    return joined;
}

std::vector<std::size_t> chain_voxels(const Image& mask) {
    const Voxels voxels(mask);
    std::vector<std::size_t> chain;
    voxels.for_each_inside([&](const VoxelIndex& at) {
        if (voxels.is_chain(at)) chain.push_back(voxels.offset(at));
    });
    return chain;
}

namespace {

/// \param for_each calls visit(index) for the voxels inside that keep their width
template <class ForEach>
Image keeping_width(const Voxels& voxels, const Image& mask, const Image& field,
                    const ForEach& for_each) {
    const Vec3 spacing = mask.spacing();
    const auto half = static_cast<float>(0.5 * spacing.minCoeff());
    std::vector<float> values = *field.voxels;
    std::vector<std::pair<VoxelIndex, float>> thin;
    for_each([&](const VoxelIndex& at) {
        const float share = least_share(voxels, at);
        if (share == 0.0f) return;
        float& value = values[voxels.offset(at)];
        value = std::max(value, half);
        thin.emplace_back(at, share);
    });
    for (const auto& [at, share] : thin) {
        const float beyond = -values[voxels.offset(at)] * (1.0f - share) / share;
        for (const VoxelIndex& face : kFaces) {
            const VoxelIndex beside = at + face;
            if (!voxels.is_there(beside) || voxels.is_in(beside)) continue;
            float& value = values[voxels.offset(beside)];
            value = std::max(value, std::min(beyond, -kNearest * half));
        }
    }
    return with_voxels(field, std::move(values));
}

}  // namespace

Image with_voxel_width(const Image& mask, const Image& field) {
    const Voxels voxels(mask);
    return keeping_width(voxels, mask, field,
                         [&](const auto& visit) { voxels.for_each_inside(visit); });
}

Image with_voxel_width(const Image& mask, const Image& field, std::span<const std::size_t> only) {
    const Voxels voxels(mask);
    return keeping_width(voxels, mask, field, [&](const auto& visit) {
        for (const std::size_t voxel : only)
            if (const VoxelIndex at = index_of(mask, voxel); voxels.is_in(at)) visit(at);
    });
}

}  // namespace vesselbench
