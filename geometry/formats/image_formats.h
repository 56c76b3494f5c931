#pragma once

#include "geometry/formats/format.h"
#include "geometry/formats/loaded_image.h"

namespace vesselbench {

using ImageFormat = FormatRow<ImageFile, Image>;

/// The table of image formats that read_image_file and write_image know.
[[nodiscard]] const std::vector<ImageFormat>& image_formats();

}  // namespace vesselbench
