#pragma once

#include <string>

#include "geometry/formats/loaded_image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads NRRD (.nrrd, or .nhdr with its data beside it; raw, gzip or text encoding). Its space
/// (RAS, LAS, LPS) becomes LPS; without one, LPS is assumed, with a note. Segments that 3D Slicer
/// names in the header are read, and the layers of those that overlap. Source: "Definition of
/// NRRD file format", teem.sourceforge.net/nrrd/format.html.
/// \throw as read_image_file
[[nodiscard]] ImageFile read_nrrd(const std::string& path);

/// Writes one compressed file. \throw IoError, Cancelled
void write_nrrd(const Image& image, const std::string& path, const Progress& progress = {});

}  // namespace vesselbench
