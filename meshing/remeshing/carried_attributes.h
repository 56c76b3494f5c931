#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The result with the source's attributes, interpolated at the source's closest points.
[[nodiscard]] Surface with_attributes_of(const Surface& source, Surface result);

}  // namespace vesselbench
