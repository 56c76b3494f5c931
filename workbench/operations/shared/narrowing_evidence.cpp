#include "workbench/operations/shared/narrowing_evidence.h"

#include "geometry/image/threshold.h"

namespace vesselbench {

std::optional<ImageEvidence> narrowing_evidence(const Scene& scene,
                                                const std::vector<WallRing>& rings,
                                                const Narrowing& narrowing) {
    if (!scene.image || judge(*scene.image).kind != ImageKind::Intensity) return std::nullopt;
    return image_evidence(*scene.image, rings, narrowing);
}

}  // namespace vesselbench
