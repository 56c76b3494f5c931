#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/measure_json.h"

namespace vesselbench {

/// An opening: its patch's figures, and the tilt and bend of the vessel just inside it (null if
/// they cannot be measured).
/// \param patch one of measure_patches(surface)
[[nodiscard]] nlohmann::ordered_json opening_json(const Surface& surface,
                                                  const PatchMeasures& patch, Keys keys);

}  // namespace vesselbench
