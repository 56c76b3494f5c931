#pragma once

#include <optional>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/ends/patch_shape.h"
#include "geometry/vessel/openings/angle.h"

namespace vesselbench {

/// The vessel's direction at an opening, from the centroids of the sections up to two diameters
/// inward: a cubic fitted by least squares. As far as the sections' radii scatter, as on a surface
/// with staircases, their centroids count less, and a vessel's usual curvature counts instead.
struct OpeningAxis {
    Vec3 direction = Vec3::UnitZ();  ///< of length 1, out of the vessel
    double tilt_deg = 0.0;           ///< between the plane's normal and the axis
    double bend_deg = 0.0;           ///< turn of the vessel over one diameter, from the same fit
    double doubt_deg = 0.0;          ///< standard deviation of the direction
    double diameter = 0.0;           ///< of the circle with the opening's area [mm]
    double depth = 0.0;              ///< of the innermost section used [diameters]
    int sections = 0;                ///< number of sections used: fewer if a furcation comes first
};

/// Measured at a plane whose normal points out of the vessel and whose point lies inside it. Empty
/// if there are fewer than 3 sections: they end where the area changes by more than a factor of
/// 1.4, or where the curve is not closed.
/// \param diameter of the opening [mm]
/// \param outward how far the vessel's sections are whole beyond the plane, too [mm]
[[nodiscard]] std::optional<OpeningAxis> axis_inward(const Surface& surface, const Plane& plane,
                                                     double diameter, double outward = 0.0);

/// The axis by the wall's vertices (wall_axis), if these show it better than the sections do.
/// \param by_sections measured at the plane
/// \param whole where the wall becomes a tube, inward from the plane [mm]
[[nodiscard]] std::optional<OpeningAxis> axis_by_wall(const Surface& surface, const Plane& plane,
                                                      const OpeningAxis& by_sections,
                                                      double whole = 0.0);

/// The axis at a flat cap, by sections or by the wall. \throw InvalidInput if the surface has no
/// such patch
[[nodiscard]] std::optional<OpeningAxis> axis_at_patch(const Surface& surface, std::size_t patch);

/// Angle [deg] between a cap's normal and the vessel's axis just inside it (axis_at_patch); 90 if
/// the axis cannot be measured. \throw InvalidInput if the surface has no such patch
[[nodiscard]] double opening_tilt_deg(const Surface& surface, std::size_t patch);

}  // namespace vesselbench
