#pragma once

#include <cstddef>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// Plane, area and flatness of a patch.
struct PatchShape {
    Plane plane;            ///< through the centroid; area-weighted mean normal, outward
    double area = 0.0;      ///< [mm^2]
    double flatness = 0.0;  ///< largest distance of a vertex from the plane [mm]

    [[nodiscard]] double diameter() const;  ///< of the circle of this area [mm]
};

/// \throw InvalidInput if the surface has no such patch, or it has no triangles
[[nodiscard]] PatchShape patch_shape(const Surface& surface, std::size_t patch);

/// Mean angle between the wall behind a patch and the patch's mean plane [deg], by area, from half
/// the patch's radius behind it, where a rounded rim ends, to a whole one: 90 for a cap across a
/// tube, less for a flat place of a dome. Without such a wall, 90.
/// \throw InvalidInput if the surface has no such patch
[[nodiscard]] double wall_rise_deg(const Surface& surface, std::size_t patch);

/// The triangles with a corner within a distance of a point, as a separate surface: measuring on it
/// is fast.
[[nodiscard]] Surface part_near(const Surface& surface, const Vec3& centre, double radius);

}  // namespace vesselbench
