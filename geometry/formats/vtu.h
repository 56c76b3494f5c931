#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Reads the surface (append_grid_surface) of a VTK XML unstructured grid (.vtu), with the same
/// arrays as read_vtp().
/// \throw InvalidInput for a damaged or truncated file, or cells that are not read; IoError if the
/// file cannot be read
[[nodiscard]] RawSurface read_vtu_surface(const std::string& path);

}  // namespace vesselbench
