#pragma once

#include <cstddef>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What was taken back of a filter's result.
struct TakenBack {
    std::size_t vertices = 0;        ///< that moved less than the filter wanted
    Vec3 place = Vec3::Zero();       ///< of the first crossing [mm]
    std::size_t crossings_left = 0;  ///< pairs of triangles
};

/// Takes a filter's displacement back around the places where it would make the surface pass
/// through itself: thin walls, walls that touch. A few rings around them fade from none to all of
/// it; wider ones, the longer crossings remain.
/// \param moved positions after the filter, #V [mm]; changed in place
/// \return all zero if there is no new crossing, also where the surface itself crossed before
TakenBack take_back_crossings(const Surface& surface, Positions& moved,
                              const Progress& progress = {});

}  // namespace vesselbench
