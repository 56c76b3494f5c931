#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Labels the flat caps that close vessels (find_flat_closures) as patches cut_1, cut_2 ..., and
/// moves the vertices inside them into the planes of their rims. Steps of a staircase are no caps:
/// a voxel mask's wall has many faces parallel to each of them, another vessel's has hardly any.
/// \return the surface itself if it is open, has openings already, or has no such caps
[[nodiscard]] Surface label_flat_caps(const Surface& surface);

}  // namespace vesselbench
