#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Distance of every vertex to the nearest source [mm] that can be reached along edges whose
/// vertices all lie within `reach` [mm] of that source; infinite if there is none. Exact,
/// bit-identical for any number of threads. Nearly every vertex is settled by the source nearest to
/// it in space and a straight walk to it, n log n in all. The vertices left open, at sheets within
/// the reach of each other, are settled by a search from each source in doubt: up to sources in
/// doubt times vertices within the reach.
/// \param sources ascending, at finite positions; vertices at positions that are not finite have no
/// distance
[[nodiscard]] std::vector<double> connected_distances(const Topology& topology,
                                                      const Positions& positions,
                                                      const std::vector<VertexId>& sources,
                                                      double reach);

/// A vertex with sources within reach, the nearest of which may not reach it.
struct OpenVertex {
    VertexId vertex = 0;
    /// The nearest source known to reach it; the largest number: none.
    VertexId known = std::numeric_limits<VertexId>::max();
};

/// The same for a few vertices that a search elsewhere left open, in their order.
[[nodiscard]] std::vector<double> open_distances(const Topology& topology,
                                                 const Positions& positions,
                                                 const std::vector<VertexId>& sources, double reach,
                                                 std::span<const OpenVertex> open);

}  // namespace vesselbench
