#pragma once

#include <array>
#include <vector>

#include "geometry/editing/local_part.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// A vessel that leaves the surroundings of a contact.
struct ContactArm {
    std::vector<VertexId> rim;     ///< of the part, where the vessel leaves it
    Vec3 centre = Vec3::Zero();    ///< of the rim [mm]
    Vec3 outward = Vec3::UnitZ();  ///< along the vessel, away from the contact; unit
    double radius = 0.0;           ///< of the circle of the section's area [mm]
};

/// The wall around a contact: one piece of it, inside a ball.
struct ContactZone {
    Vec3 centre = Vec3::Zero();        ///< of the ball [mm]
    double reach = 0.0;                ///< radius of the ball [mm]
    std::vector<std::uint8_t> marked;  ///< 1 at the part's triangles, #T of the whole
    LocalPart part;
    std::array<ContactArm, 4> arms;
};

/// The wall in the smallest ball around a place from which four arms leave as whole sections of one
/// vessel each, and, as far as these stay four, some way beyond it.
/// \param places of the surface
/// \param beyond that ball, at most [radii of the widest arm]
/// \throw DiagnosedFailure "contact-without-arms" with how many there are instead: a tip or a
/// furcation is near, or there is only one vessel; Cancelled if the user cancels
[[nodiscard]] ContactZone contact_zone(const Surface& surface, const SurfaceDistance& places,
                                       const Vec3& centre, double beyond, const Progress& cancel);

}  // namespace vesselbench
