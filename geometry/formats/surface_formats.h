#pragma once

#include "geometry/formats/format.h"
#include "geometry/formats/raw_surface.h"

namespace vesselbench {

using SurfaceFormat = FormatRow<RawSurface, Surface>;

/// The table of surface formats that read_surface and write_surface know.
[[nodiscard]] const std::vector<SurfaceFormat>& surface_formats();

}  // namespace vesselbench
