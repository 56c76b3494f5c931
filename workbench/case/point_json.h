#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A point or a direction in the form used in reports: [x, y, z].
[[nodiscard]] nlohmann::ordered_json point_json(const Vec3& point);

}  // namespace vesselbench
