#pragma once

#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/handles.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What a handle of a vessel's lumen means, with its place, width and length around:
/// "handle-artefact" if it goes around less than a vessel does, else "handle".
[[nodiscard]] Diagnostic handle_warning(const SurfaceHandle& handle);

/// One warning for each handle of a vessel's lumen, with its place, width and length around, and
/// with `separate` as its remedy where that parts two vessels; of very many, their number. Blood
/// can go around through a handle: true for a ring of vessels, an artefact where two vessels merely
/// touch in the image. \throw Cancelled if the user cancels
[[nodiscard]] std::vector<Diagnostic> handle_warnings(const Surface& surface,
                                                      const Progress& progress);

}  // namespace vesselbench
