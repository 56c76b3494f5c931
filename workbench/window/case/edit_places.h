#pragma once

#include "workbench/session/snapshot.h"

namespace vesselbench {

/// Where an edit was made, as far as its arguments say [mm]: its points, the middle dab of a
/// stroke, the planes of openings. Empty for edits of the whole surface.
[[nodiscard]] Positions places_of_edit(const LogEntry& entry);

}  // namespace vesselbench
