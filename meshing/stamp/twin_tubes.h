#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "meshing/stamp/contact_arms.h"

namespace vesselbench {

/// Where a point is beside a tube.
struct TubePlace {
    std::size_t segment = 0;
    double t = 0.0;       ///< along the segment, 0 ... 1
    double height = 0.0;  ///< distance from the tube's wall [mm], negative inside
};

/// A line with radii.
struct FittedTube {
    Positions centres;          ///< [mm]
    std::vector<double> radii;  ///< [mm], one per centre

    [[nodiscard]] TubePlace place(const Vec3& x) const;

    [[nodiscard]] double height(const Vec3& x) const { return place(x).height; }
};

/// Two vessels through a contact, as tubes.
struct TwinTubes {
    std::array<FittedTube, 2> tubes;                   ///< each from one of its arms to the other
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
