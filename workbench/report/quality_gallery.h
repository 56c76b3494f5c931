#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/picture.h"

namespace vesselbench {

/// A changed model in a gallery.
struct GalleryModel {
    Surface surface;
    std::vector<std::string> captions;  ///< lines below it
};

/// The preview gallery (thesis 6.5.6, Figs. 6.18 and 6.19): the models side by side, coloured by
/// their deviation from the original; below them an artifact, magnified, under the wireframe of the
/// original (or its own, if it has other triangles); a colour scale in mm.
/// \param at place of the artifact [mm]; none: the largest deviation of the middle model
/// \throw GpuUnavailable if there is no usable OpenGL
[[nodiscard]] Picture quality_gallery(const Surface& original,
                                      const std::vector<GalleryModel>& models,
                                      const std::string& title, const std::optional<Vec3>& at);

}  // namespace vesselbench
