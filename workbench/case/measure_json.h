#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/triangle_shape.h"
#include "meshing/tetrahedra/quality.h"
#include "workbench/case/edit_record.h"

namespace vesselbench {

// One vocabulary for figures, for all commands and operations.

/// The document of `vesselbench measure --json` [mm, mm^2, mm^3, degrees].
[[nodiscard]] nlohmann::ordered_json measure_json(const SurfaceMeasures& measures);

/// Its "reference" part.
[[nodiscard]] nlohmann::ordered_json reference_json(const ReferenceComparison& comparison);

/// Its figures of triangle shape: `equiangle_skewness` and `radius_ratio`.
[[nodiscard]] nlohmann::ordered_json triangle_shape_json(const TriangleShape& shape);

/// An edit's effect on the surface, units in the keys; null for what was not measured.
[[nodiscard]] nlohmann::ordered_json change_json(const SurfaceChange& change);

/// Reads it back; what is null or absent was not measured. \throw nlohmann::json::exception if a
/// count is missing
[[nodiscard]] SurfaceChange change_from(const nlohmann::ordered_json& json);

/// Quality of a volume mesh, units in the keys.
[[nodiscard]] nlohmann::ordered_json volume_quality_json(const VolumeQuality& quality);

/// Diameter of the circle of the same area [mm].
[[nodiscard]] double diameter_of_area(double area);

}  // namespace vesselbench
