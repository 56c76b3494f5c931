#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The points' numbers along a curve that fills space (Morton's): what is near in space is near in
/// this order, and a range of it is a region. Does not depend on the number of threads.
/// Source: Morton, "A computer oriented geodetic data base", IBM 1966.
[[nodiscard]] std::vector<VertexId> space_order(const Positions& points);

}  // namespace vesselbench
