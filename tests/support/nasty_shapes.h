#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

struct NastyShape {
    std::string name;
    Surface surface;
};

/// Small surfaces, each broken in one way: without area, non-manifold, open, with isolated
/// vertices, inverted, flat, all cap, tiny, huge, self-intersecting. All positions are finite.
[[nodiscard]] std::vector<NastyShape> nasty_shapes();

}  // namespace vesselbench::test
