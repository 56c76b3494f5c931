#include "gpu/picture_view.h"

#include <algorithm>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr int kLargestSide = 8192;

}  // namespace

void require_size(const PictureOptions& options) {
    if (std::min(options.width, options.height) < 1 ||
        std::max(options.width, options.height) > kLargestSide)
        throw InvalidInput("a picture must be 1 to 8192 pixels wide and high");
}

SceneView view_of(const Surface& frame, const PictureOptions& options) {
    SceneView view;
    view.rectangle = {0, 0, options.width, options.height};
    view.camera =
        framed({.view = options.view, .up = options.up}, frame.points(), view.rectangle.aspect());
    view.camera.half_height =
        options.half_height > 0.0 ? options.half_height : view.camera.half_height / options.zoom;
    view.camera.centre += options.shift;
    view.background = Background{options.background, options.background};
    return view;
}

}  // namespace vesselbench
