#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Squared distances to the nearest known source, before the exact ones are settled.
struct DistanceSearch {
    const CompressedRows& rings;
    const Positions& x;
    double squared_reach;
    const std::vector<VertexId>& sources;
    std::vector<double> squared;    ///< #V; infinite: none known
    std::vector<VertexId> nearest;  ///< #V, where `squared` is finite: the source of that distance
    std::vector<std::uint8_t> is_source;  ///< #V

    [[nodiscard]] double squared_distance(VertexId v, VertexId source) const {
        return (x[v] - x[source]).squaredNorm();
    }
};

/// A source that is closer to a vertex than any source known to reach it, but may not reach it.
struct Doubt {
    VertexId source;
    VertexId vertex;
    auto operator<=>(const Doubt&) const = default;
};

/// One flood for every source in doubt: gives the vertices in doubt the distances of those sources
/// that do reach them, if these are smaller than their current ones.
/// \param doubts ascending
void settle_doubts(DistanceSearch& search, const std::vector<Doubt>& doubts);

}  // namespace vesselbench
