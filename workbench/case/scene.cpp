#include "workbench/case/scene.h"

#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

const Surface& surface_of(const Scene& scene) {
    if (!scene.surface || scene.surface->empty())
        throw AlgorithmFailure(
            "there is no surface: use load-surface first, or load-image and extract-surface");
    return *scene.surface;
}

Scene with_surface(const Scene& scene, Surface surface) {
    Scene result = scene;
    result.surface = std::move(surface);
    result.volume_mesh.reset();
    return result;
}

}  // namespace vesselbench
