#pragma once

#include <optional>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// A vessel's direction from its wall's vertices.
struct WallAxis {
    Vec3 direction = Vec3::UnitZ();  ///< of length 1, out of the vessel
    double bend_deg = 0.0;           ///< turn of the vessel over one diameter inward
    double doubt_deg = 0.0;          ///< standard deviation of the direction
    double scatter = 0.0;            ///< of the vertices off the fitted wall [diameters]
};

/// A stretch of vessel by depth inward from a plane [diameters].
struct Stretch {
    double from = 0.0;
    double to = 1.0;
};

/// The direction just inside a plane, by a tube fitted to the vertices of the wall: a line of
/// degree 5 around which the distance is a quadratic along it, and out of round by the same amount
/// everywhere. Vertices off it count less. Of several lengths the one with the least doubt is
/// taken. Sections of a vessel three triangles wide lie off its wall between the vertices, and
/// their centroids with them; the vertices, where they were before smoothing (unsmoothed), do not.
/// \param plane its normal points out of the vessel, its point lies inside it
/// \param diameter of the vessel there [mm]
/// \param whole where the wall is a tube: neither beyond the vessel's end nor in a furcation
/// \return empty if the wall is not that of a surface without noise: the vertices scatter by more
/// than two thousandths of the diameter, or are too few
[[nodiscard]] std::optional<WallAxis> wall_axis(const Surface& surface, const Plane& plane,
                                                double diameter, const Stretch& whole);

}  // namespace vesselbench
