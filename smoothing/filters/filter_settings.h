#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "smoothing/filters/position_constraint.h"

namespace vesselbench {

/// Where a continued run began.
struct EarlierRun {
    const Positions* start = nullptr;  ///< positions before its first iteration [mm], #V
    int iterations = 0;                ///< iterations done so far
};

/// Settings common to all filters.
struct FilterSettings {
    int iterations = 20;  ///< >= 0
    /// Per-vertex factor in [0, 1] on the final displacement of each iteration, #V (Eq. 5.1);
    /// empty: 1 everywhere.
    std::span<const double> weights = {};
    /// 1 where a vertex is fixed, #V; empty: none. A fixed vertex also stays in every intermediate
    /// state of an iteration, so its neighbours see it unmoved.
    std::span<const std::uint8_t> fixed = {};
    bool keep_boundary = true;  ///< boundary vertices of an open surface are fixed
    int rings = 1;              ///< neighbourhood: 1 or 2 rings around a vertex
    std::optional<PositionConstraint> constraint = {};  ///< no vertex leaves its cell
    /// Set if the positions given result from an earlier run of the same filter: both runs together
    /// are then equal to one run of all iterations, bit for bit. None: an independent run.
    std::optional<EarlierRun> earlier = {};
};

/// \throw InvalidInput if the settings ask for more than one ring
void require_one_ring(const char* filter, const FilterSettings& settings);

/// 1 where a filter must not move a vertex: the fixed ones and, with keep_boundary, those on the
/// boundary of an open surface; #V.
/// \throw InvalidInput if the settings do not fit the topology, or a position is not finite
[[nodiscard]] std::vector<std::uint8_t> checked_fixed_vertices(const Topology& topology,
                                                               const Positions& positions,
                                                               const FilterSettings& settings);

/// Positions before the first iteration: those given, or those the earlier run began with.
[[nodiscard]] inline const Positions& start_of(const Positions& positions,
                                               const FilterSettings& settings) {
    return settings.earlier ? *settings.earlier->start : positions;
}

}  // namespace vesselbench
