#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Whether a surface is closed, its triangles all run the same way round, and every part of it
/// encloses a positive volume: its inner side is then seen from inside only.
[[nodiscard]] bool is_solid_surface(const Surface& surface);

}  // namespace vesselbench
