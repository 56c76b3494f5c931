#pragma once

#include <string>
#include <string_view>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Reads legacy VTK poly data (.vtk, text or binary, versions 1 to 5.1): polygons and strips, cell
/// array CellEntityIds (or ModelFaceID) as parts, point arrays of one component as attributes. A
/// separate parser, because VTK's crashes on truncated files.
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_legacy_vtk(const std::string& path);

/// True if a legacy VTK file that begins with these bytes holds poly data.
[[nodiscard]] bool is_legacy_poly_data(std::string_view head);

}  // namespace vesselbench
