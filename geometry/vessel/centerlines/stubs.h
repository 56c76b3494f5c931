#pragma once

#include <memory>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_parameters.h"

namespace vesselbench {

/// A blind branch that is too short for a line of its own: a bump of the wall, a sac, or what is
/// left of a vessel that was closed near its furcation.
struct Stub {
    Vec3 root = Vec3::Zero();  ///< where it leaves the middle of its parent [mm]
    Vec3 exit = Vec3::Zero();  ///< where it leaves the parent's inscribed spheres [mm]
    Vec3 tip = Vec3::Zero();   ///< on its wall, about [mm]
    double length = 0.0;       ///< from there to the wall at its tip [mm]
    double widest = 0.0;       ///< radius of its largest inscribed sphere out there [mm]
    double parent = 0.0;       ///< radius of the parent's at the root [mm]
};

/// What `centerlines_of` left out, longest first; found with the lines, once.
/// \throw what centerlines_of throws
[[nodiscard]] std::shared_ptr<const std::vector<Stub>> stubs_of(
    const Surface& surface, const CenterlineParameters& parameters = {},
    const Progress& progress = {}, DerivedCache& cache = derived_cache());

}  // namespace vesselbench
