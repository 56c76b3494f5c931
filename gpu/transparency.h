#pragma once

#include "gpu/png.h"

namespace vesselbench {

/// The picture on nothing, of the same one drawn on black and on white: whatever lets the white
/// through is transparent, also in part, as smooth edges are.
/// \throw InvalidInput if their sizes differ
[[nodiscard]] ClearPicture without_background(const Picture& on_black, const Picture& on_white);

}  // namespace vesselbench
