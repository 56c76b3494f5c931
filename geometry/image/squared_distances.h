#pragma once

#include <vector>

namespace vesselbench {

/// Means "no outline in this line": far beyond any image, but its square is still exact in float.
inline constexpr float kFarSquared = 1e15f;

/// Squared distances along one line, in place: d(p) = min over q of (h (p - q))^2 + d(q). Over the
/// lines of each axis in turn they become those in space, from 0 at the voxels that count and
/// kFarSquared elsewhere.
/// Source: Felzenszwalb, Huttenlocher, "Distance transforms of sampled functions", Theory of
/// Computing 2012.
/// \param h distance between neighbours [mm]
void squared_distances(std::vector<float>& line, double h);

}  // namespace vesselbench
