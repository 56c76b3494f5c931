#pragma once

#include <optional>

#include "smoothing/context/context_finder.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// Direction across the slices of a surface's image.
struct StackAxis {
    Vec3 direction = Vec3::UnitZ();    ///< unit
    std::optional<double> confidence;  ///< of an estimate, in [0, 1] [-]; none: of the image
};

/// The axis of the scene's image; of a surface without one, an estimate from its faces beside the
/// caps. None if that is uncertain.
/// \param finder of the scene's surface; its caps are found only for an estimate
/// \pre the scene has a surface
[[nodiscard]] std::optional<StackAxis> stack_axis_of(const Scene& scene, ContextFinder& finder);

}  // namespace vesselbench
