#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads a Wavefront OBJ file: points, polygons (also by negative indices) and groups; normals,
/// textures, materials and colours are ignored.
/// \throw InvalidInput for a damaged file or an index out of range, IoError if it cannot be read
[[nodiscard]] RawSurface read_obj(const std::string& path);

/// One group per patch; comments state the unit and the model's provenance.
void write_obj(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
