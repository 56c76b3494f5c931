#pragma once

#include <span>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// True if a planar face of this direction is a step of a staircase and no vessel's end: much of
/// the wall is parallel to it, in more planes than the ends of a vessel lie in. So it is on
/// surfaces midway between a mask's voxels. \param points [mm]
/// \param wall triangles, without the planar faces in question
/// \param direction unit normal of the face
[[nodiscard]] bool is_terrace(const Positions& points, std::span<const Triangle> wall,
                              const Vec3& direction);

}  // namespace vesselbench
