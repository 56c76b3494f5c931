#include "geometry/kernel/simple_point.h"

#include <array>
#include <bit>

namespace vesselbench {

namespace {

constexpr NeighbourBits kAll = (NeighbourBits{1} << 27) - 1;
constexpr int kCentre = 13;

struct BlockMasks {
    std::array<NeighbourBits, 27> near26{};  ///< 26-neighbours of each cell within the block
    std::array<NeighbourBits, 27> near6{};   ///< 6-neighbours of each cell within the block
    NeighbourBits within18 = 0;              ///< 18-neighbours of the centre
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
            const auto bit = NeighbourBits{1} << b;
            if (!adjacent || a == b) continue;
            if (b != kCentre) m.near26[static_cast<std::size_t>(a)] |= bit;
            if (di + dj + dk == 1 && b != kCentre) m.near6[static_cast<std::size_t>(a)] |= bit;
            if (a == kCentre && di + dj + dk <= 2) m.within18 |= bit;
        }
    }
    return m;
}

constexpr BlockMasks kMasks = make_masks();

/// All cells of `set` that are connected to `seed`.
NeighbourBits flood(NeighbourBits seed, NeighbourBits set,
                    const std::array<NeighbourBits, 27>& near) {
    NeighbourBits reached = seed;
    NeighbourBits front = seed;
    while (front != 0) {
        const int cell = std::countr_zero(front);
        front &= front - 1;
        const NeighbourBits fresh = near[static_cast<std::size_t>(cell)] & set & ~reached;
        reached |= fresh;
        front |= fresh;
    }
    return reached;
}

NeighbourBits around_centre(NeighbourBits object) {
    return object & kAll & ~(NeighbourBits{1} << kCentre);
}

NeighbourBits lowest(NeighbourBits set) {
    return set & (~set + 1);
}

}  // namespace

bool connects_parts(NeighbourBits object) {
    const NeighbourBits around = around_centre(object);
    return around != 0 && flood(lowest(around), around, kMasks.near26) != around;
}

bool is_simple(NeighbourBits object) {
    const NeighbourBits around = around_centre(object);
    if (around == 0 || connects_parts(around)) return false;
    const NeighbourBits background = ~around & kMasks.within18;
    const NeighbourBits at_faces = background & kFaceNeighbours;
    if (at_faces == 0) return false;
    return (at_faces & ~flood(lowest(at_faces), background, kMasks.near6)) == 0;
}

bool is_simple_both_ways(NeighbourBits object) {
    return is_simple(object) && is_simple(~object);
}

}  // namespace vesselbench
