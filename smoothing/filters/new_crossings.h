#pragma once

#include <cstddef>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The part of a filter's result that was reverted.
struct TakenBack {
    std::size_t vertices = 0;        ///< that moved less than the filter computed
    Vec3 place = Vec3::Zero();       ///< of the first crossing [mm]
    std::size_t crossings_left = 0;  ///< pairs of triangles
};

/// Reverts a filter's displacement around the places where the surface would pass through itself:
/// thin walls, walls that touch. Around them the displacement fades in over a few rings, from none
/// to all of it; the longer crossings persist, the more rings.
/// \param moved positions after the filter, #V [mm]; changed in place
/// \return all zero if there is no new crossing, even if the surface itself crossed before
TakenBack take_back_crossings(const Surface& surface, Positions& moved,
                              const Progress& progress = {});

}  // namespace vesselbench
