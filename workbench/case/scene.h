#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "geometry/image/image.h"
#include "geometry/image/segment.h"
#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// All data of a case at one state: an immutable value with shared parts (DESIGN 1).
struct Scene {
    std::optional<Surface> surface;
    std::optional<Image> image;
    std::optional<Image> mask;                  ///< labels or a level set on the image's grid
    Segmentation segmentation;                  ///< of the mask, else of the image's labels
    std::optional<Sampling> sampling;           ///< of the surface's source image, if known
    std::map<std::string, Surface> neighbours;  ///< other structures, for distance awareness
    std::shared_ptr<const VolumeMesh> volume_mesh;
};

/// The scene's surface.
/// \throw AlgorithmFailure that names the operations to make one, if there is none
[[nodiscard]] const Surface& surface_of(const Scene& scene);

/// The scene with another surface; a volume mesh of the old one is dropped.
[[nodiscard]] Scene with_surface(const Scene& scene, Surface surface);

}  // namespace vesselbench
