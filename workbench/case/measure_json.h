#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/triangle_shape.h"
#include "meshing/tetrahedra/quality.h"
#include "workbench/case/edit_record.h"

namespace vesselbench {

// One vocabulary for figures, for all commands and operations: one function per thing, in one of
// two forms. The document of `measure` has fixed keys without units; everything else, such as an
// operation's report, adds the unit to the same key (`area_mm2`), and calls the largest of several
// distances `largest_mm` (docs/science/measures.md).

/// How keys are written.
enum class Keys {
    Plain,      ///< `area`: in the document of `measure` and what repeats it
    WithUnits,  ///< `area_mm2`: everywhere else
};

/// The document of `vesselbench measure --json` [mm, mm^2, mm^3, degrees].
[[nodiscard]] nlohmann::ordered_json measure_json(const SurfaceMeasures& measures);

/// One of its patches, or with units an opening in an operation's report.
[[nodiscard]] nlohmann::ordered_json patch_json(const PatchMeasures& patch, Keys keys);

/// Its "reference" part.
[[nodiscard]] nlohmann::ordered_json reference_json(const ReferenceComparison& comparison);

/// Its figures of triangle shape: `equiangle_skewness` and `radius_ratio`.
[[nodiscard]] nlohmann::ordered_json triangle_shape_json(const TriangleShape& shape);

/// Volume [mm^3] and area [mm^2], units in the keys.
[[nodiscard]] nlohmann::ordered_json extent_json(double volume, double area);

/// Figures of several distances [mm], units in the keys: `mean_mm`, `largest_mm`, and
/// `percentile_95_mm` if it is given.
[[nodiscard]] nlohmann::ordered_json distance_json(double mean, double largest,
                                                   std::optional<double> percentile_95 = {});

/// An edit's effect on the surface, units in the keys; null for what was not measured.
[[nodiscard]] nlohmann::ordered_json change_json(const SurfaceChange& change);

/// Reads it back; what is null or absent was not measured. \throw InvalidInput if a
/// count is missing
[[nodiscard]] SurfaceChange change_from(const nlohmann::ordered_json& json);

/// Quality of a volume mesh, units in the keys.
[[nodiscard]] nlohmann::ordered_json volume_quality_json(const VolumeQuality& quality);

/// Diameter of the circle of the same area [mm].
[[nodiscard]] double diameter_of_area(double area);

}  // namespace vesselbench
