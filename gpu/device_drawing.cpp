#include "gpu/device_drawing.h"

#include <utility>

#include "gpu/picture_view.h"
#include "gpu/render/target.h"

namespace vesselbench {

namespace {

SurfaceLayer layer_of(const DeviceState& state, const PictureOptions& options) {
    SurfaceLayer layer;
    layer.colouring = state.values != nullptr ? Colouring::Values : Colouring::Base;
    layer.map = ColourMap::Heated;
    layer.least = state.least;
    layer.most = state.most;
    layer.back = options.back;
    if (options.edges) layer.edges = Edges::Over;
    return layer;
}

}  // namespace

DeviceDrawing::DeviceDrawing(std::shared_ptr<const DeviceSurface> surface)
    : surface_(std::move(surface)), drawn_(std::make_shared<DrawnDeviceSurface>(surface_)) {}

Picture DeviceDrawing::picture_of(const DeviceState& state, const PictureOptions& options) {
    require_size(options);
    drawn_->show({&state.shifts, &state.normals, state.values});
    Layers layers{.surfaces = {layer_of(state, options)}};
    layers.surfaces.front().source = drawn_;
    RenderTarget target(options.width, options.height);
    target.bind();
    renderer_.draw(view_of(surface_->surface(), options), layers);
    Picture picture = target.picture();
    require_context(surface_->device());
    return picture;
}

}  // namespace vesselbench
