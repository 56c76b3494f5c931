#pragma once

#include "geometry/formats/format.h"
#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// A writer takes the line on the model's provenance that goes into the file's header.
using SurfaceFormat = FormatRow<RawSurface, Surface, const std::string&>;

/// The table of surface formats that read_surface and write_surface know.
[[nodiscard]] const std::vector<SurfaceFormat>& surface_formats();

}  // namespace vesselbench
