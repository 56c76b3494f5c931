#pragma once

#include "geometry/kernel/progress.h"
#include "workbench/case/edit_record.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What an edit did to the scene's surface. Where the connectivity stayed, deviations go from each
/// vertex to its old place, their mean over the vertices that moved. Else they go from the vertices
/// of either surface to the other surface, their mean over all vertices of both; of more than
/// 50,000 that stand on no vertex of the other, every n-th is measured.
/// \throw Cancelled
[[nodiscard]] SurfaceChange surface_change(const Scene& before, const Scene& after,
                                           const Progress& progress = {});

}  // namespace vesselbench
