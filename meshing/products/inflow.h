#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Shape of the fully developed laminar flow through a flat cross-section of any shape: the
/// solution of Laplace(u) = -1 with u = 0 on the rim, scaled to a mean of 1 over the area. On a
/// circle it is 2 (1 - (r / R)^2). Linear finite elements on the triangles, each divided into 16.
/// \param triangles the cross-section's, in any order
/// \return mean of u over each triangle [-], in their order
/// \throw InvalidInput if the triangles have no rim
[[nodiscard]] std::vector<double> developed_profile(const Positions& positions,
                                                    const std::vector<Triangle>& triangles);

}  // namespace vesselbench
