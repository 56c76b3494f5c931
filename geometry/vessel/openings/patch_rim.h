#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The border between a cap and the wall.
struct PatchRim {
    std::vector<VertexId> loop;    ///< in the direction of the cap's half-edges
    std::uint16_t wall_label = 0;  ///< of the triangles on the other side
};

/// \throw AlgorithmFailure if the patch is not bordered by exactly one simple loop
[[nodiscard]] PatchRim patch_rim(const Surface& surface, std::size_t patch);

}  // namespace vesselbench
