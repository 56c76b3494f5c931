#pragma once

#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Orientation of every face relative to the image stack [-]: 0 if the face's normal is parallel to
/// the stack axis, 1 if it is orthogonal; 0 for degenerate faces. #T
/// Source: thesis Eq. 5.3.
/// \param stack_axis any length but 0
/// \throw InvalidInput if the axis has no direction
[[nodiscard]] std::vector<double> face_orientations(const Topology& topology,
                                                    const Positions& positions,
                                                    const Vec3& stack_axis);

/// Orientation change theta' of every vertex [-]: the largest minus the smallest orientation of the
/// faces around it, in [0, 1]; 0 in flat areas, 1 at perfect staircase edges. Degenerate faces are
/// ignored. #V
/// Source: thesis Eq. 5.4.
/// \throw InvalidInput if the axis has no direction
[[nodiscard]] std::vector<double> orientation_change(const Topology& topology,
                                                     const Positions& positions,
                                                     const Vec3& stack_axis);

/// \throw InvalidInput if the axis has no direction
[[nodiscard]] Vec3 unit_axis(const Vec3& stack_axis);

}  // namespace vesselbench
