#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A point or a direction in the form used in reports: [x, y, z].
[[nodiscard]] nlohmann::ordered_json point_json(const Vec3& point);

/// The point of such a form.
/// \throw nlohmann::json::exception if it is none
[[nodiscard]] Vec3 point_from(const nlohmann::ordered_json& json);

}  // namespace vesselbench
