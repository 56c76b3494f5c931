#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What of a surface tells its unit, all lengths in the file's unit.
struct VesselSize {
    double extent = 0.0;    ///< diagonal of the bounding box
    double edge = 0.0;      ///< mean length
    double distance = 0.0;  ///< of the bounding box's centre from the origin
    double side = 0.0;      ///< root of the area
    double radius = 0.0;    ///< typical: twice the volume over the area; 0: it is meaningless
    double opening = 0.0;   ///< radius of the smallest round opening; 0: none
    double mouth = 0.0;     ///< radius of the largest one
};

/// \param surface not empty
[[nodiscard]] VesselSize vessel_size(const Surface& surface);

/// How well a surface can be a vessel if its unit has so many millimetres: the logarithm of the
/// density of such vessels, as scripts/fit_units.py fitted it to the surfaces of many patients
/// (docs/science/units.md), lowered for openings, areas and extents beyond all vessels'.
[[nodiscard]] double log_plausibility(const VesselSize& size, double millimetres);

/// True if no vessel is as long [mm].
[[nodiscard]] bool is_beyond_vessels(double extent);

}  // namespace vesselbench
