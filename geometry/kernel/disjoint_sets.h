#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace vesselbench {

/// The numbers 0 ... count - 1 in disjoint sets (union-find with path halving). The smallest member
/// is the root of its set, whatever the order of the joins: numberings derived from roots are
/// reproducible, unlike those of boost::disjoint_sets, which depend on ranks.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }

    [[nodiscard]] std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// \return false if both are already in one set
    bool join(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax({root(a), root(b)});
        parent_[high] = low;
        return low != high;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace vesselbench
