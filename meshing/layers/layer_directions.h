#pragma once

#include <span>
#include <vector>

#include "meshing/layers/layered_wall.h"

namespace vesselbench {

/// The direction that has the largest smallest dot product with all of some vectors, scaled by it;
/// zero if no direction has a positive one with each. The point of their convex hull nearest to the
/// origin. Source: Gilbert, "An iterative procedure for computing the minimum of a quadratic form
/// on a convex set", SIAM J. Control 4, 1966; for layers: Aubry, Loehner, "On the 'most normal'
/// normal", 2008.
/// \param vectors not empty
[[nodiscard]] Vec3 most_normal(std::span<const Vec3> vectors);

/// Unit directions into the lumen [-], #V, along which the layers grow: the inward normals, turned
/// to those of their neighbours as long as each still sees all triangles at its vertex. At rims
/// they lie in the opening's plane.
/// \throw DiagnosedFailure "layers-at-fold", with the place, where no direction sees all triangles
[[nodiscard]] Positions layer_directions(const LayeredWall& wall);

}  // namespace vesselbench
