#pragma once

#include "gpu/picture_options.h"
#include "gpu/render/layers.h"

namespace vesselbench {

/// \throw InvalidInput unless the picture is 1 to 8192 pixels wide and high
void require_size(const PictureOptions& options);

/// A parallel view of all of a picture that frames a surface.
/// \throw InvalidInput if the options' directions are parallel
[[nodiscard]] SceneView view_of(const Surface& frame, const PictureOptions& options);

}  // namespace vesselbench
