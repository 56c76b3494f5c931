#pragma once

#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "workbench/case/stated_change.h"

namespace vesselbench {

/// Wall that an edit took away.
struct LostWall {
    Vec3 place = Vec3::Zero();  ///< [mm]
    double distance = 0.0;      ///< from the new wall [mm]
    double stated = 0.0;        ///< that the operation states for this place [mm]
};

/// The farthest wall that is lost beyond what an operation states (`wall_lost`, `radii_lost`) and
/// belongs to no end that it names; none: there is none.
/// \throw Cancelled
[[nodiscard]] std::optional<LostWall> lost_wall(const StatedChange& stated, const Surface& before,
                                                const Surface& after,
                                                const Progress& progress = {});

}  // namespace vesselbench
