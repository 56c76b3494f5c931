#pragma once

#include <cstddef>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Splits the patches of kind Cut into their connected parts, named cut_1 (the largest), cut_2 ...
/// \param smallest a part of less area [mm^2] is no vessel's end, but a touch: it becomes wall
/// \throw AlgorithmFailure if there are more than the patch table holds
[[nodiscard]] Surface with_separate_cuts(const Surface& surface, double smallest = 0.0);

/// Pieces of an iso-surface: a shell is outward (a body) or inward (a hollow in a body).
struct ShellChoice {
    Surface surface;               ///< the chosen shells
    std::size_t bodies = 0;        ///< outward shells there were
    std::size_t hollows = 0;       ///< inward shells there were
    double largest_dropped = 0.0;  ///< volume [mm^3] of the largest body left out
};

/// The body of largest volume, without its hollows.
/// \throw AlgorithmFailure if there is no body
[[nodiscard]] ShellChoice largest_body(const Surface& surface);

/// The smallest body that holds the point; else the nearest one within `tolerance` [mm].
/// \throw AlgorithmFailure that says how far the nearest body is
[[nodiscard]] ShellChoice body_at(const Surface& surface, const Vec3& point, double tolerance);

/// All shells, hollows too.
[[nodiscard]] ShellChoice all_bodies(const Surface& surface);

}  // namespace vesselbench
