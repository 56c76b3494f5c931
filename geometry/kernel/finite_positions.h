#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// \throw InvalidInput that names the first vertex whose position is not finite
void require_finite(const Positions& positions);

/// Where memory or time grows with the extent. \throw InvalidInput as require_finite(), and that
/// names the first vertex more than 10 km [1e7 mm] from the origin, as damaged files have them
void require_near(const Positions& positions);

}  // namespace vesselbench
