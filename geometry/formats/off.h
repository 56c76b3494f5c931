#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads a text OFF file (also COFF, NOFF, CNOFF; colours and normals are ignored).
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_off(const std::string& path);

/// Comments state the unit and the model's provenance; the format cannot store patches and
/// attributes.
void write_off(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
