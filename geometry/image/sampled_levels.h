#pragma once

#include <cstddef>

#include "geometry/image/image.h"
#include "geometry/image/vessel_body.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The volume at a threshold over that at the levels [-], as WallLevels::volume_at_threshold. In
/// an image of more voxels than `most` it comes from boxes that are spread over the vessel, in
/// which levels are found: their contrast is that of the boxes.
/// \param most voxels in which levels are found, about
/// \throw as find_levels (level_field.h), where no box has levels
[[nodiscard]] double volume_at_threshold(const Image& image, double threshold,
                                         const VesselBody& body, std::size_t most,
                                         const Progress& progress = {});

}  // namespace vesselbench
