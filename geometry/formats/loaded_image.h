#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/image/segment.h"

namespace vesselbench {

/// An image as read from a file.
struct ImageFile {
    Image image;                 ///< [mm], LPS, with the file's true orientation
    std::string format;          ///< name of its row in image_formats()
    std::optional<double> unit;  ///< [mm] the file's stated unit; none if it states none
    std::vector<std::string>
        notes;  ///< what was missing in the file, and the assumptions made instead
    std::vector<Segment> segments = {};  ///< that the file names, in its order
    /// Segments that overlap: `image` holds the first layer, these the others. A segment's label is
    /// then its number in the file, and `stored` says where its voxels are.
    std::vector<Image> layers = {};

    /// A segment's voxels: a value in a layer.
    struct Stored {
        std::size_t layer = 0;
        int value = 0;
    };

    std::vector<Stored> stored = {};  ///< of each of `segments`, if there are layers
};

}  // namespace vesselbench
