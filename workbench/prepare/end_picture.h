#pragma once

#include "geometry/vessel/openings/openings.h"
#include "gpu/picture.h"

namespace vesselbench {

/// The surface from the front and from the left, with the numbers of its vessel ends beside them:
/// in the colours of their roles (role_colour).
/// \throw GpuUnavailable without usable OpenGL
[[nodiscard]] Picture picture_of_ends(const Surface& surface, const OpeningPlan& plan);

}  // namespace vesselbench
