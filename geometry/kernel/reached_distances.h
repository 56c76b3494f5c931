#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>

namespace vesselbench {

/// Distances for ShortestPaths where a search reaches few vertices; infinite where nothing is
/// known.
class ReachedDistances {
public:
    double& operator[](std::uint32_t vertex) {
        return known_.try_emplace(vertex, std::numeric_limits<double>::infinity()).first->second;
    }

private:
    std::unordered_map<std::uint32_t, double> known_;
};

}  // namespace vesselbench
