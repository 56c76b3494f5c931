#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A piece of wall that a plane cuts off, with its cut.
struct SacPart {
    Plane neck;                         ///< its normal points into the sac
    Positions points;                   ///< [mm]
    std::vector<Triangle> triangles;    ///< of the wall; open at the neck
    std::vector<TriangleId> whole;      ///< triangles of the surface that the plane does not cross
    Positions outline;                  ///< of the neck [mm], pairs of ends of its segments
    double wall_area = 0.0;             ///< [mm^2]
    double volume = 0.0;                ///< between wall and plane [mm^3]
    double neck_area = 0.0;             ///< [mm^2]
    double neck_perimeter = 0.0;        ///< [mm]
    Vec3 neck_centroid = Vec3::Zero();  ///< of the neck's area [mm]
};

/// The wall around a dome, as far as a plane.
/// \param dome vertex of the surface
/// \param foreign 1 for vertices that belong to no sac, such as those of open ends; #V
/// \return nothing if the dome is not above the plane, if a foreign vertex is connected to it there,
///         or if the cut is not one closed curve
[[nodiscard]] std::optional<SacPart> sac_above(const Surface& surface, const Plane& plane,
                                               VertexId dome,
                                               const std::vector<std::uint8_t>& foreign);

}  // namespace vesselbench
