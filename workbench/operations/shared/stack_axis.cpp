#include "workbench/operations/shared/stack_axis.h"

#include "smoothing/context/stack_orientation.h"

namespace vesselbench {

std::optional<StackAxis> stack_axis_of(const Scene& scene, ContextFinder& finder) {
    if (scene.sampling && scene.sampling->confidence > 0.0)
        return StackAxis{scene.sampling->axes.col(2), std::nullopt};
    const StackOrientation estimate = estimate_stack_orientation(*scene.surface, finder.caps());
    if (!estimate.certain) return std::nullopt;
    return StackAxis{estimate.direction, estimate.confidence};
}

}  // namespace vesselbench
