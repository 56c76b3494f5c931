#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"

namespace vesselbench {

/// The document of `vesselbench measure --json` [mm, mm^2, mm^3, degrees].
[[nodiscard]] nlohmann::ordered_json measure_json(const SurfaceMeasures& measures);

/// Its "reference" part.
[[nodiscard]] nlohmann::ordered_json reference_json(const ReferenceComparison& comparison);

/// Diameter of the circle of the same area [mm].
[[nodiscard]] double diameter_of_area(double area);

}  // namespace vesselbench
