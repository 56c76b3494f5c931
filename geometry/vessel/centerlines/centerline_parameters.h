#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

struct CenterlineParameters {
    /// Vessel ends [mm] instead of the automatic search. Boundary loops and flat patches are ends
    /// in any case. A point may lie on the wall or inside; it must be within one local radius of
    /// the lumen.
    Positions ends;
    /// Search for blind ends (of closed surfaces, and of stubs of open ones). Otherwise only loops,
    /// flat patches and `ends` are ends.
    bool find_blind_ends = true;
    /// A blind branch is kept if it protrudes from its parent's wall by more than this many times
    /// the parent's radius [-] ...
    double blind_beyond_parent = 1.0;
    /// ... and by more than this many times its own largest radius [-]: a round sac (length 2 radii
    /// and a neck) is not a branch, a stub is.
    double blind_slenderness = 2.5;
    double spacing = 0.2;  ///< distance of the line's points in local radii [-], in [0.02, 0.5]
};

}  // namespace vesselbench
