#pragma once

#include <optional>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Which body of an image is the vessel.
struct VesselBody {
    std::optional<Vec3> seed;  ///< [mm] a point in it; absent: the largest body
    bool all = false;          ///< all bodies are vessels
};

}  // namespace vesselbench
