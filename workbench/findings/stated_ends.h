#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "geometry/vessel/ends/end_odds.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

/// What an edit that decided the vessel ends stated of one of them.
struct StatedEnd {
    Vec3 place = Vec3::Zero();  ///< [mm]
    double diameter = 0.0;      ///< of its vessel [mm]
    EndOdds odds;
};

/// Of the last edit of a variant that decided its ends; ends whose odds cannot be read are left
/// out.
[[nodiscard]] std::vector<StatedEnd> stated_ends(const std::vector<LogEntry>& log);

/// The nearest one that is the same end: within its vessel's diameter, since the tip of a sac moves
/// with every smoothing, and neither vessel more than twice as wide as the other; null: none.
/// \param diameter of the vessel at the place [mm]
[[nodiscard]] const StatedEnd* stated_at(std::span<const StatedEnd> stated, const Vec3& place,
                                         double diameter);

}  // namespace vesselbench
