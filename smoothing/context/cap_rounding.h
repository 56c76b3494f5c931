#pragma once

#include <vector>

#include "smoothing/context/caps.h"

namespace vesselbench {

/// Domes every cap, for the smooth endings that visualisation wants (thesis 5.3). The profile from
/// the rim to the cap's middle is a quarter ellipse that leaves the rim in the wall's direction and
/// arrives flat, so that neither has an edge; vertices slide towards the rim, so that they are
/// spread evenly over the dome. The dome leans with the wall, whose mean direction at the rim
/// counts, up to 45 degrees from the cap's normal. Where caps have ridges (an ellipse has), the
/// dome is lower, as everywhere nearer to the rim.
/// Connectivity stays: a cap of a few large triangles becomes a blunt cone. The rim stays, too;
/// where it is jagged, a filter over dome and wall is to follow. Nothing keeps a dome out of other
/// parts of the surface that are as near as it is high.
/// \param height of the dome by the cap's inner radius [-], 0 < height <= 2; 1: a half ball
/// \return positions [mm], #V; those of all other vertices are unchanged, bit for bit
/// \throw InvalidInput if height is out of its range
[[nodiscard]] Positions rounded_caps(const Surface& surface, const std::vector<Cap>& caps,
                                     double height = 1.0);

}  // namespace vesselbench
