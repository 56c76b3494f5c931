#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

using Corners = std::array<Vec3, 3>;  ///< of one triangle [mm]

/// 1 for every probe that meets or touches a triangle of the surface, in the order of the probes.
[[nodiscard]] std::vector<std::uint8_t> touching(const Surface& surface,
                                                 std::span<const Corners> probes);

}  // namespace vesselbench
