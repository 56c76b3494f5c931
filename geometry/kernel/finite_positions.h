#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// \throw InvalidInput that names the first vertex whose position is not finite, or more than 10 km
/// [1e7 mm] from the origin, as damaged files have them
void require_finite(const Positions& positions);

}  // namespace vesselbench
