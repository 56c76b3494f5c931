#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A part of the lumen that is narrower than wanted.
struct NarrowPlace {
    Vec3 place = Vec3::Zero();  ///< on the wall, where it is narrowest [mm]
    double width = 0.0;         ///< of the lumen there [mm]
};

/// Where the lumen is narrower than `width` [mm], narrowest first; caps and rims do not count.
/// \throw InvalidInput without a triangle or with a width that is not positive; AlgorithmFailure if
/// it is longer than the diagonal of the surface's bounding box; Cancelled
[[nodiscard]] std::vector<NarrowPlace> narrow_places(const Surface& surface, double width,
                                                     const Progress& progress = {});

/// Moves walls apart where the lumen is narrower than `width` [mm], until it is that wide or the
/// mesh does not permit more; the displacement fades out along the wall. A thread that an image
/// shows as less than its voxels becomes a vessel that can be meshed. Caps, rims and the rest of
/// the wall stay where they are. Walls may cross others near them outside: see take_back_crossings.
/// \return positions, #V [mm]
/// \throw as above
[[nodiscard]] Positions widen(const Surface& surface, double width, const Progress& progress = {});

}  // namespace vesselbench
