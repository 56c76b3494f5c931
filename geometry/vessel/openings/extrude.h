#pragma once

#include <cstddef>

#include "geometry/kernel/surface.h"

namespace vesselbench {

enum class ExtrusionProfile { Keep, Circle };

struct ExtrusionParameters {
    double length = 0.0;  ///< [mm], > 0
    ExtrusionProfile profile = ExtrusionProfile::Circle;
    double blend = 0.5;  ///< share of the length over which the profile becomes a circle, (0, 1]
    bool may_shorten = true;  ///< false: exactly this length, or a failure
};

struct Extrusion {
    Surface surface;
    double length = 0.0;     ///< that was made [mm]
    bool shortened = false;  ///< the wanted length would have hit the surface
};

/// Lengthens a vessel straight along the normal of its flat cap. The new wall has the label of the
/// wall at the rim and triangles of the rim's edge length; every section has the cap's area; the
/// cap moves to the end and keeps its patch. Where the extrusion would come nearer to the rest of
/// the surface than a quarter of its diameter at its front or a tenth of its radius at its sides,
/// it ends before; a length that must not be shortened only has to be free of contact.
/// \throw InvalidInput if there is no such patch, or a parameter is out of its range
/// \throw AlgorithmFailure if the cap is not flat or not one disc, or less than half a diameter is
///        free, or the length may not be shortened and the extrusion would meet the surface
[[nodiscard]] Extrusion extrude_opening(const Surface& surface, std::size_t patch,
                                        const ExtrusionParameters& parameters);

}  // namespace vesselbench
