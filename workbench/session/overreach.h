#pragma once

#include <optional>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/case/stated_change.h"

namespace vesselbench {

/// The first way in which a surface changed more than an operation states, with its place and
/// figures; none: it did not, or one of the scenes has no surface. Searches for crossings are
/// limited to the triangles that changed.
/// \throw Cancelled
[[nodiscard]] std::optional<Diagnostic> overreach(const StatedChange& stated, const Scene& before,
                                                  const Scene& after,
                                                  const Progress& progress = {});

}  // namespace vesselbench
