#pragma once

#include <array>
#include <vector>

#include "meshing/stamp/contact_arms.h"
#include "meshing/stamp/twin_tubes.h"

namespace vesselbench {

/// The wall between two vessels that belongs to neither.
struct ContactBridge {
    std::vector<std::uint8_t> own;      ///< 0 or 1: the tube that a vertex is nearer to, by vertex
    std::vector<std::uint8_t> removed;  ///< 1 at triangles of the bridge, #T of the part
    Vec3 centre = Vec3::Zero();         ///< [mm]
    double width = 0.0;                 ///< across the vessels [mm]
    double length = 0.0;                ///< along the vessels [mm]
    std::array<double, 2> radii = {};   ///< of the vessels at its middle [mm]
};

/// The bridge: what lies midway between the tubes, and the wall around it that stands off its tube.
/// What it cuts off from the arms belongs to it.
/// \throw DiagnosedFailure "contact-not-parted" if it reaches an arm's rim, or if two pieces, each
/// with the two arms of one vessel, do not remain
[[nodiscard]] ContactBridge contact_bridge(const ContactZone& zone, const TwinTubes& twins);

/// Removes the triangles around the bridge as well.
/// \throw DiagnosedFailure as contact_bridge()
void widen_bridge(const ContactZone& zone, const TwinTubes& twins, ContactBridge& bridge);

}  // namespace vesselbench
