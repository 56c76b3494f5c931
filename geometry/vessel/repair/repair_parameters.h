#pragma once

#include <cstddef>
#include <optional>

namespace vesselbench {

struct RepairParameters {
    /// Open loops up to this radius [mm] are closed; none: those that are not vessel ends.
    std::optional<double> close_holes_up_to;
    std::size_t keep_components = 1;  ///< number to keep, largest area first
    /// Of a wall with two sides: keep the outer one, not that of the lumen.
    bool outer_wall = false;
    bool remove_self_intersections = true;
    /// Edges and triangle heights below this fraction of the mean edge length [-] are removed.
    double smallest_feature = 1e-3;
};

}  // namespace vesselbench
