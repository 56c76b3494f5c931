#include "workbench/case/scene.h"

#include <utility>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

const Surface& surface_of(const Scene& scene) {
    if (!scene.surface || scene.surface->empty())
        throw DiagnosedFailure({.code = "no-surface",
                                .remedies = {{.operation = "load-surface"},
                                             {.operation = "load-image"},
                                             {.operation = "extract-surface"}}});
    return *scene.surface;
}

Scene with_surface(const Scene& scene, Surface surface) {
    Scene result = scene;
    result.surface = std::move(surface);
    result.volume_mesh.reset();
    return result;
}

}  // namespace vesselbench
