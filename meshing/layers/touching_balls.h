#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/layers/layered_wall.h"

namespace vesselbench {

/// Radius [mm] of the largest ball inside the lumen that touches the wall at each vertex, with its
/// centre on the inward normal: it bounds the wall's curvature and the distance of the wall
/// opposite at once. Starts from half the way across and shrinks until no vertex and no triangle's
/// middle lies inside; what is seen from the centre within 30 degrees of the vertex is its own
/// neighbourhood and does not count. Openings do not limit it.
/// Source: Ma, Bae, Choi, "3D medial axis point approximation using nearest neighbors and the
/// normal field", The Visual Computer 28, 2012.
[[nodiscard]] std::vector<double> touching_balls(const LayeredWall& wall,
                                                 const Progress& progress = {});

/// Radius of the vessel [mm] around each vertex: the median of the touching balls nearby. Creases
/// and bumps do not show in it, sacs and tapering do.
/// \param balls of `touching_balls`
[[nodiscard]] std::vector<double> vessel_radii(const LayeredWall& wall,
                                               const std::vector<double>& balls,
                                               const Progress& progress = {});

}  // namespace vesselbench
