#pragma once

#include <optional>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How far a replay of what a GPU computed is from its stored result.
struct ReplayDistance {
    double largest = 0.0;  ///< [mm]
    bool allowed = false;  ///< as devices may differ: 1e-5 of the bounding box's diagonal at 99.9 %
                           ///< of the vertices, 5e-4 at all
};

/// Compares the positions of two surfaces, vertex by vertex; nothing where they have different
/// numbers of them.
[[nodiscard]] std::optional<ReplayDistance> replay_distance(const Surface& stored,
                                                            const Surface& replayed);

}  // namespace vesselbench
