#pragma once

#include "workbench/edit_record.h"
#include "workbench/scene.h"

namespace vesselbench {

/// What an edit did to the scene's surface. Where the connectivity is shared, deviations go from
/// each vertex to its old place, their mean over the vertices that moved.
[[nodiscard]] SurfaceChange surface_change(const Scene& before, const Scene& after);

}  // namespace vesselbench
