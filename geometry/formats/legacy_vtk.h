#pragma once

#include <string>
#include <string_view>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Reads a surface of a legacy VTK file (text or binary, versions 1 to 5.1): polygons and strips of
/// poly data, or the surface of an unstructured grid (append_grid_surface); cell array
/// CellEntityIds (or ModelFaceID) as parts, point arrays of one component as attributes. A separate
/// parser, because VTK's crashes on truncated files.
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_legacy_vtk(const std::string& path);

/// True if a legacy VTK file that begins with these bytes holds a surface.
[[nodiscard]] bool is_legacy_surface(std::string_view head);

}  // namespace vesselbench
