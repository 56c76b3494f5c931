#pragma once

#include <cstddef>
#include <optional>

#include "geometry/kernel/piece_shape.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Splits the patches of kind Cut into their connected parts, named cut_1 (the largest), cut_2 ...
/// \param smallest a part of less area [mm^2] is a touch, not a vessel's end: it becomes wall
/// \throw AlgorithmFailure if there are more parts than the patch table can hold
[[nodiscard]] Surface with_separate_cuts(const Surface& surface, double smallest = 0.0);

/// Pieces of an iso-surface: a shell is outward (a body) or inward (a cavity in a body).
struct ShellChoice {
    Surface surface;                           ///< the chosen shells
    std::size_t bodies = 0;                    ///< number of outward shells
    std::size_t hollows = 0;                   ///< number of inward shells
    double largest_dropped = 0.0;              ///< volume [mm^3] of the largest body dropped
    std::optional<PieceShape> dropped_vessel;  ///< the longest body dropped that is a vessel
};

/// The body of largest volume, without its cavities.
/// \throw AlgorithmFailure if there is no body
[[nodiscard]] ShellChoice largest_body(const Surface& surface);

/// The smallest body that contains the point; else the nearest one within `tolerance` [mm].
/// \throw AlgorithmFailure that states the distance to the nearest body
[[nodiscard]] ShellChoice body_at(const Surface& surface, const Vec3& point, double tolerance);

/// All shells, including cavities.
[[nodiscard]] ShellChoice all_bodies(const Surface& surface);

}  // namespace vesselbench
