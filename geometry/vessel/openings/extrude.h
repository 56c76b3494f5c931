#pragma once

#include <cstddef>
#include <optional>

#include "geometry/kernel/surface.h"

namespace vesselbench {

enum class ExtrusionProfile { Keep, Circle };

struct ExtrusionParameters {
    /// [mm], > 0, along the direction; at most 100 diagonals of the surface's bounding box.
    double length = 0.0;
    /// Out of the vessel, at most 60 degrees from the cap's normal, any length but 0; none: the
    /// normal. Sections stay parallel to the cap.
    std::optional<Vec3> direction = {};
    ExtrusionProfile profile = ExtrusionProfile::Circle;
    double blend = 0.5;  ///< fraction of the length over which the profile becomes a circle, (0, 1]
    bool may_shorten = true;  ///< false: exactly this length, or none
};

struct Extrusion {
    Surface surface;
    double length = 0.0;     ///< actual length [mm]; 0: there is no room, the surface is as it was
    bool shortened = false;  ///< the requested length would have hit the surface
};

/// Lengthens a vessel straight along the normal of its flat cap, or obliquely. The new wall has the
/// label of the wall at the rim and triangles of the rim's edge length; every section has the cap's
/// area; the cap moves to the end and keeps its patch. If the extrusion would come closer to the
/// rest of the surface than a quarter of its diameter at the front or a tenth of its radius at the
/// sides, it ends earlier; with a length that must not be shortened, it only has to be free of
/// contact. There is no room for it with less than half a diameter free, or if it must not be
/// shortened and would meet the surface.
/// \throw InvalidInput if there is no such patch, or a parameter is out of its range
/// \throw AlgorithmFailure if the cap is not flat or not a single disc; or that names the length
/// possible if the one asked for is too long, or needs more than 4 million triangles
[[nodiscard]] Extrusion extrude_opening(const Surface& surface, std::size_t patch,
                                        const ExtrusionParameters& parameters);

}  // namespace vesselbench
