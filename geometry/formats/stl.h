#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads an STL file, binary or text, with one or several solids; equal points become one vertex.
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_stl(const std::string& path);

/// Writes binary STL (single precision); the header states the unit, and as much of the model's
/// provenance as fits.
void write_stl(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
