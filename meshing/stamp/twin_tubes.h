#pragma once

#include <array>
#include <cstddef>

#include "geometry/vessel/tree/tube.h"
#include "meshing/stamp/contact_arms.h"

namespace vesselbench {

/// Two vessels through a contact, as tubes.
struct TwinTubes {
    std::array<Tube, 2> tubes;                         ///< each from one of its arms to the other
    std::array<std::array<std::size_t, 2>, 2> arms{};  ///< of the zone, by tube
    double noise = 0.0;    ///< standard deviation of the wall from its tube, robust [mm]
    double misfit = 0.0;   ///< share of wall and tubes that the other does not have [-]
    double overlap = 0.0;  ///< how far the tubes enter each other, of the thinner's radius [-]
};

/// The two tubes of one pairing, fitted to the wall that faces away from the other vessel: least
/// squares of the wall's distances, robust (Tukey's biweight), with lines and radii that bend as
/// little as the wall allows.
/// \param partner of the first arm, 1 ... 3
[[nodiscard]] TwinTubes twin_tubes(const ContactZone& zone, std::size_t partner);

}  // namespace vesselbench
