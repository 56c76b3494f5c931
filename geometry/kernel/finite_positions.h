#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// \throw InvalidInput that names the first vertex whose position is not finite
void require_finite(const Positions& positions);

}  // namespace vesselbench
