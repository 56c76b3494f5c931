#pragma once

#include <cstddef>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// Numbers of voxels in classes of values of equal width.
struct ImageHistogram {
    double least = 0.0, most = 0.0;   ///< ends of the classes [image's unit]
    std::vector<std::size_t> counts;  ///< empty: all voxels are equal
};

/// The histogram without the 0.02 % of the voxels at either end, which would squeeze all others
/// into few classes.
/// \param image not empty
/// \param classes above 0
[[nodiscard]] ImageHistogram histogram_of(const Image& image, std::size_t classes);

}  // namespace vesselbench
