#pragma once

#include <string>

#include "geometry/formats/loaded_image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads MetaImage (.mha, or .mhd with its data beside it; compressed or not, binary or text). The
/// rows of its matrix are the directions of the axes; its space is LPS, as in ITK.
/// Source: "MetaIO", itk.org/Wiki/MetaIO/Documentation.
/// \throw as read_image_file
[[nodiscard]] ImageFile read_meta_image(const std::string& path);

/// Writes one compressed file. \throw IoError, Cancelled
void write_meta_image(const Image& image, const std::string& path, const Progress& progress = {});

}  // namespace vesselbench
