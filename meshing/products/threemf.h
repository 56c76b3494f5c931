#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Writes one object in millimetres as 3MF (3D Manufacturing Format, core specification 1.2), with
/// the model's provenance as its description. Of several closed bodies each is a component with a
/// name: "part 1", "part 2" ...
/// \throw InvalidInput if the surface has no triangle, or is not closed and oriented; IoError,
/// Cancelled
void write_3mf(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
