#pragma once

#include <vector>

#include "smoothing/caps.h"

namespace vesselbench {

/// Domes every cap, for the smooth endings that visualisation wants (thesis 5.3): a cap vertex
/// rises along the cap's normal, by nothing at the rim, by the cap's inner radius at its middle, on
/// the profile of a quarter ellipse, so that a wall that stands upright on the rim goes over into
/// the dome without an edge. Connectivity stays: a cap of a few large triangles becomes a blunt
/// cone. \return positions [mm], #V; those of all other vertices are unchanged, bit for bit
[[nodiscard]] Positions rounded_caps(const Surface& surface, const std::vector<Cap>& caps);

}  // namespace vesselbench
