#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/iso_surface.h"

namespace vesselbench::test {

/// What else is at a contact of two vessels.
enum class Crowd : std::uint8_t {
    Sac,        ///< it is no vessel but the dome of a sac that touches the other one
    Furcation,  ///< one of the vessels branches near by
    Third,      ///< another vessel passes both
    Thread      ///< there is no contact, but a thread from one vessel to the other
};

/// Two vessels that are blended where they touch, and something that must not be lost there.
struct CrowdedContact {
    Surface surface;
    Vec3 place = Vec3::Zero();  ///< in the middle of the contact [mm]
    Positions kept;             ///< poles of the sac and ends of all vessels [mm]
    std::vector<int> vessels;   ///< to which each of them belongs
    double thinnest = 0.0;      ///< radius of the thinnest vessel [mm]
};

/// \param number of the phantom: sizes, angles and distances are drawn by it
/// \param cell of the grid that the surface is made on [mm]
[[nodiscard]] CrowdedContact crowded_contact(Crowd crowd, std::uint64_t number, double cell = 0.4);

/// True if places of one vessel are on different parts of a surface.
[[nodiscard]] bool cuts_vessel(const CrowdedContact& contact, const Surface& after);

/// How much farther from the wall than before the places lie that must be kept, at most [mm].
[[nodiscard]] double farthest_kept(const CrowdedContact& contact, const Surface& after);

}  // namespace vesselbench::test
