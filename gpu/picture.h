#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/picture_options.h"

namespace vesselbench {

/// Draws a surface off-screen, 4 samples per pixel, orthographic, on white unless told
/// otherwise.
/// \throw GpuUnavailable if there is no usable OpenGL; InvalidInput for an empty surface or an
/// unusable size
[[nodiscard]] Picture draw(const Surface& surface, const PictureOptions& options = {});

/// One picture per view, in one context, whose shaders are compiled once.
[[nodiscard]] std::vector<Picture> draw_views(const Surface& surface,
                                              std::span<const PictureOptions> views);

/// The colours in which pictures show a surface's patches, by label.
[[nodiscard]] std::vector<Colour> patch_colours(const Surface& surface);

/// The up direction of a picture for a view direction: the head or, from above or below, the front.
[[nodiscard]] Vec3 upward_for(const Vec3& view);

}  // namespace vesselbench
