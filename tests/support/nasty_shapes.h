#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

struct NastyShape {
    std::string name;
    Surface surface;
};

/// Small surfaces that are broken in one way each: without area, not manifold, open, with vertices
/// in the air, turned over, flat, all cap, tiny, huge, through themselves. All positions are
/// finite.
[[nodiscard]] std::vector<NastyShape> nasty_shapes();

}  // namespace vesselbench::test
