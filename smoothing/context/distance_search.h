#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Squared distances to the nearest known source, on the way to the exact ones.
struct DistanceSearch {
    const CompressedRows& rings;
    const Positions& x;
    double squared_reach;
    const std::vector<VertexId>& sources;
    std::vector<double> squared;          ///< #V; infinite: none known
    std::vector<VertexId> nearest;        ///< #V, where `squared` is finite: whose distance it is
    std::vector<std::uint8_t> is_source;  ///< #V

    [[nodiscard]] double squared_distance(VertexId v, VertexId source) const {
        return (x[v] - x[source]).squaredNorm();
    }
};

/// A source that is nearer to a vertex than any that is known to reach it, but may not reach it.
struct Doubt {
    VertexId source;
    VertexId vertex;
    auto operator<=>(const Doubt&) const = default;
};

/// One flood for every source that is in doubt: gives the vertices in doubt the distances of those
/// sources that do reach them, where these are smaller than what they have.
/// \param doubts ascending
void settle_doubts(DistanceSearch& search, const std::vector<Doubt>& doubts);

}  // namespace vesselbench
