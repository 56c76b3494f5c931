#pragma once

#include <optional>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Distance of a replayed GPU result from the stored one.
struct ReplayDistance {
    double largest = 0.0;  ///< [mm]
    bool allowed = false;  ///< as devices may differ: 1e-5 of the bounding box's diagonal at 99.9 %
                           ///< of the vertices, 5e-4 at all
};

/// Compares the positions of two surfaces, vertex by vertex; empty if the numbers of vertices
/// differ.
[[nodiscard]] std::optional<ReplayDistance> replay_distance(const Surface& stored,
                                                            const Surface& replayed);

}  // namespace vesselbench
