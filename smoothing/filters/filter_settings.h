#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "smoothing/filters/position_constraint.h"

namespace vesselbench {

/// Where a run that goes on from an earlier one began.
struct EarlierRun {
    const Positions* start = nullptr;  ///< positions before its first iteration [mm], #V
    int iterations = 0;                ///< that it has done
};

/// What all filters have in common.
struct FilterSettings {
    int iterations = 20;  ///< >= 0
    /// Per-vertex factor in [0, 1] on the final displacement of each iteration, #V (Eq. 5.1);
    /// empty: 1 everywhere.
    std::span<const double> weights = {};
    /// 1 where a vertex stays, #V; empty: none. Such a vertex stays in every intermediate state of
    /// an iteration too, so that its neighbours see it where it is.
    std::span<const std::uint8_t> fixed = {};
    bool keep_boundary = true;  ///< boundary vertices of an open surface are fixed
    int rings = 1;              ///< neighbourhood: 1 or 2 rings around a vertex
    std::optional<PositionConstraint> constraint = {};  ///< no vertex leaves its cell
    /// The positions given are those that an earlier run of the same filter left: both together do
    /// what one run of all iterations does, bit for bit. None: a run of its own.
    std::optional<EarlierRun> earlier = {};
};

/// \throw InvalidInput if the settings ask for more than one ring
void require_one_ring(const char* filter, const FilterSettings& settings);

/// 1 where a filter leaves a vertex alone: the fixed ones and, with keep_boundary, those on the
/// boundary of an open surface; #V.
/// \throw InvalidInput if the settings do not fit the topology, or a position is not finite
[[nodiscard]] std::vector<std::uint8_t> checked_fixed_vertices(const Topology& topology,
                                                               const Positions& positions,
                                                               const FilterSettings& settings);

/// Positions before the first iteration: those given, or where the earlier run began.
[[nodiscard]] inline const Positions& start_of(const Positions& positions,
                                               const FilterSettings& settings) {
    return settings.earlier ? *settings.earlier->start : positions;
}

}  // namespace vesselbench
