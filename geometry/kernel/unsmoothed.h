#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

// Where the vertices of a smoothed surface lay before, as vertex attributes unsmoothed_x, _y, _z
// [mm]. Smoothing moves the vertices of coarse triangles off a wall that they lay on: directions
// are measured where they came from.

/// The smoothed surface with the places before. Those that it has already, from an earlier
/// smoothing, stay. \throw InvalidInput unless `before` is #V long
[[nodiscard]] Surface with_unsmoothed(Surface smoothed, const Positions& before);

/// The places before smoothing, #V; the surface's own positions if it has none.
[[nodiscard]] Positions unsmoothed(const Surface& surface);

[[nodiscard]] Surface without_unsmoothed(Surface surface);

}  // namespace vesselbench
