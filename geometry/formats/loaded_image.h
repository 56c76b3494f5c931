#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// An image as read from a file.
struct ImageFile {
    Image image;                 ///< [mm], LPS, with the file's true orientation
    std::string format;          ///< name of its row in image_formats()
    std::optional<double> unit;  ///< [mm] the file's stated unit; none if it states none
    std::vector<std::string>
        notes;  ///< what was missing in the file, and the assumptions made instead
};

}  // namespace vesselbench
