#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

/// The pairs (low, high) of parts whose surfaces cross, ascending. \throw Cancelled
[[nodiscard]] std::vector<BodyPair> crossing_bodies(const Surface& surface, const Components& parts,
                                                    const Progress& progress = {});

struct UnitedBodies {
    Surface surface;
    std::size_t bodies = 0;  ///< that were united
    std::size_t made = 0;    ///< of them
};

/// Unites closed bodies that cross, by their Boolean union: what is inside another one goes. The
/// other parts stay, before the united ones. Labels stay, but for those of all bodies of a union
/// except its first; attributes are dropped where something is united.
/// \param crossing pairs of parts, as from crossing_bodies()
/// \throw AlgorithmFailure with the place if two of them cannot be united
[[nodiscard]] UnitedBodies united_bodies(const Surface& surface, const Components& parts,
                                         const std::vector<BodyPair>& crossing,
                                         const Progress& progress = {});

}  // namespace vesselbench
