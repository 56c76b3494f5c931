#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Labels the flat caps that close vessels (find_flat_closures) as patches cut_1, cut_2 ..., and
/// moves the vertices inside them into the planes of their rims. Steps of a staircase are no caps:
/// a voxel mask's wall has many faces parallel to each of them, another vessel's has hardly any.
/// Some of a vessel's ends may be capped and the others open.
/// \return the surface itself if it has openings with names already, or no such caps
/// \throw Cancelled
[[nodiscard]] Surface label_flat_caps(const Surface& surface, const Progress& progress = {});

/// Without the patches of a few stray triangles: no plane has cut them.
[[nodiscard]] Surface without_stray_labels(const Surface& surface);

/// Labels planar faces that close vessels (find_flat_faces) likewise, also beside other caps and
/// open rims, and where their rims are rounded. \throw Cancelled
[[nodiscard]] Surface label_flat_faces(const Surface& surface, const Progress& progress = {});

}  // namespace vesselbench
