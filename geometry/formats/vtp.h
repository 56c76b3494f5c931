#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads VTK XML PolyData (.vtp): polygons and strips; lines and isolated points are ignored. The
/// cell array CellEntityIds (or SimVascular's ModelFaceID) gives the parts, the field array
/// PatchNames their names, point arrays of one component become attributes.
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_vtp(const std::string& path);

/// Writes .vtp in double precision (appended raw data) with CellEntityIds, PatchNames, Units,
/// the attributes, and the model's provenance as the field array Provenance.
void write_vtp(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
