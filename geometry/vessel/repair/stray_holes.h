#pragma once

#include "geometry/editing/triangle_soup.h"
#include "geometry/vessel/repair/repair_parameters.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

/// The properties of an open loop.
struct OpenLoop {
    std::vector<VertexId> vertices;
    Vec3 centre = Vec3::Zero();  ///< [mm]
    Vec3 normal = Vec3::Zero();  ///< of the enclosed area, as long as it is large [mm^2]
    double radius = 0.0;         ///< of the circle of the same area [mm]
    double roundness = 0.0;      ///< 4 pi area / length^2, without its zigzag [-]; 1: a circle
    double flatness = 0.0;       ///< largest distance from the best-fit plane over the radius [-]
    double lumen_radius = 0.0;   ///< half the free width behind the rim, median [mm]
    double elongation = 1.0;     ///< length over width of its projection, by second moments [-]
    double facing = 1.0;         ///< mean |cosine| of its normal and the wall's; 0: round a vessel
    bool from_cut = false;       ///< its rim was cut by repair itself
};

/// The loops of a manifold surface. Loops cut by repair get no lumen radius.
[[nodiscard]] std::vector<OpenLoop> open_loops(const TriangleSoup& mesh);

/// True for a vessel's end: about as wide as the lumen behind it, or a flat, round cut, or torn,
/// but running round the vessel.
[[nodiscard]] bool is_vessel_end(const OpenLoop& loop);

/// True for a loop about as wide as the lumen behind it, whether it is round or a slit.
[[nodiscard]] bool is_wide_as_lumen(const OpenLoop& loop);

/// Closes the stray holes, and all loops that repair cut itself. Fills `report.openings`.
/// \return true if something was closed
bool close_stray_holes(TriangleSoup& mesh, const RepairParameters& parameters,
                       RepairReport& report);

}  // namespace vesselbench
