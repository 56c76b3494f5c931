#pragma once

#include <optional>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// The waist of a bridge between two parts of a vessel, as an ellipse's box.
struct Contact {
    Vec3 centre = Vec3::Zero();      ///< of the waist [mm]
    Vec3 direction = Vec3::UnitZ();  ///< across the contact, from one part to the other; unit
    Vec3 along = Vec3::UnitX();      ///< the waist's longer side; unit, perpendicular to it
    double length = 0.0;             ///< of the waist [mm]
    double width = 0.0;              ///< of the waist [mm]
    double area = 0.0;               ///< of the waist [mm^2]
};

/// The contact at a place on its wall: the plane through the lumen below the place whose section is
/// smallest, slid and turned until it gets no smaller. Its direction points to +z, else +y, else
/// +x.
/// \param places of the surface
/// \return none if the lumen has no waist there: it gets wider on one side only, or on none
/// \throw InvalidInput if the point is not finite
[[nodiscard]] std::optional<Contact> contact_at(const Surface& surface,
                                                const SurfaceDistance& places, const Vec3& point);

}  // namespace vesselbench
