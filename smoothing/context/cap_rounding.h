#pragma once

#include <vector>

#include "smoothing/context/caps.h"

namespace vesselbench {

/// Turns every cap into a dome, for the smooth endings needed in visualisation (thesis 5.3). The
/// profile from the rim to the cap's middle is a quarter ellipse that leaves the rim in the wall's
/// direction and arrives flat, so that neither end has an edge; vertices slide towards the rim to
/// be spread evenly over the dome. The dome leans with the wall, by its mean direction at the rim,
/// up to 45 degrees from the cap's normal. Where caps have ridges (as in an ellipse), the dome is
/// lower, as everywhere closer to the rim. Connectivity is kept: a cap of a few large triangles
/// becomes a blunt cone. The rim is kept, too; if it is jagged, a filter over dome and wall should
/// follow. Nothing keeps a dome out of other parts of the surface that are closer than its height.
/// \param height of the dome relative to the cap's inner radius [-], 0 < height <= 2; 1: a
/// hemisphere
/// \return positions [mm], #V; those of all other vertices are unchanged, bit for bit
/// \throw InvalidInput if height is out of its range
[[nodiscard]] Positions rounded_caps(const Surface& surface, const std::vector<Cap>& caps,
                                     double height = 1.0);

}  // namespace vesselbench
