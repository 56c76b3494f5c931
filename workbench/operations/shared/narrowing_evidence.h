#pragma once

#include <optional>
#include <vector>

#include "geometry/vessel/narrowing/image_evidence.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What the scene's image says of a narrowing; empty: there is no image of intensities, or it does
/// not show the place.
/// \param rings of the narrowing's branch
[[nodiscard]] std::optional<ImageEvidence> narrowing_evidence(const Scene& scene,
                                                              const std::vector<WallRing>& rings,
                                                              const Narrowing& narrowing);

}  // namespace vesselbench
