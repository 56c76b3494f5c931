#pragma once

#include <cstdint>
#include <optional>
#include <span>

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

}  // namespace vesselbench
