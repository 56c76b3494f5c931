#pragma once

#include "gpu/colours.h"

namespace vesselbench {

/// What a vessel's end is, wherever one is shown.
enum class ShownRole {
    Inlet,
    Outlet,
    Closed,
    Sac  ///< closed, since it is likely an aneurysm
};

/// The one colour of a role, of caps, markers, tables and pictures: green, blue, violet, magenta.
[[nodiscard]] Colour role_colour(ShownRole role);

}  // namespace vesselbench
