#include "gpu/picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "gpu/context.h"
#include "gpu/picture_view.h"
#include "gpu/render/drawn_surface.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "gpu/role_colours.h"

namespace vesselbench {

namespace {

// How far another surface's edges are pulled towards the eye, relative to the frame's diagonal:
// over a smoothed surface that rose above the original.
constexpr double kWirePull = 1e-2;

Colour patch_colour(const Surface& surface, std::size_t label) {
    switch (surface.patches[label].kind) {
        case PatchKind::Wall:
            return kWallColour;
        case PatchKind::Inlet:
            return role_colour(ShownRole::Inlet);
        case PatchKind::Outlet:
            return role_colour(ShownRole::Outlet);
        case PatchKind::Cut:
            return {0.75F, 0.60F, 0.10F};
    }
    return Colour::Ones();
}

void check(const Surface& surface, const PictureOptions& options) {
    if (surface.empty()) throw InvalidInput("there is no surface to draw");
    require_size(options);
    if (!options.vertex_colours.empty() && options.vertex_colours.size() != surface.vertex_count())
        throw InvalidInput("there must be one colour per vertex");
}

SurfaceLayer layer_of(std::shared_ptr<DrawnSurface> drawn, const PictureOptions& options) {
    SurfaceLayer layer;
    layer.colouring = options.vertex_colours.empty() ? Colouring::Patches : Colouring::Vertices;
    layer.patch_colours = patch_colours(drawn->surface());
    drawn->set_colours(options.vertex_colours);
    layer.source = std::move(drawn);
    layer.back = options.back;
    layer.flat = options.sharp;
    if (options.edges) layer.edges = Edges::Over;
    return layer;
}

SurfaceLayer wires_of(const Surface& wires, double size) {
    SurfaceLayer layer;
    layer.source = std::make_shared<DrawnSurface>(prepare_drawing(wires));
    layer.edges = Edges::Only;
    layer.edge_opacity = 1.0;
    layer.pull = kWirePull * size;
    return layer;
}

Picture drawn_picture(Renderer& renderer, const std::shared_ptr<DrawnSurface>& drawn,
                      const PictureOptions& options) {
    const Surface& frame = options.frame ? *options.frame : drawn->surface();
    Layers layers{.surfaces = {layer_of(drawn, options)}};
    if (options.wires)
        layers.surfaces.push_back(wires_of(*options.wires, bounds(frame).diagonal()));
    RenderTarget target(options.width, options.height);
    target.bind();
    renderer.draw(view_of(frame, options), layers);
    return target.picture();
}

}  // namespace

Vec3 upward_for(const Vec3& view) {
    return std::abs(view.z()) < 0.95 ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
}

std::vector<Colour> patch_colours(const Surface& surface) {
    std::vector<Colour> colours;
    for (std::size_t label = 0; label < surface.patches.size(); ++label)
        colours.push_back(patch_colour(surface, label));
    return colours;
}

std::vector<Picture> draw_views(const Surface& surface, std::span<const PictureOptions> views) {
    for (const PictureOptions& options : views) check(surface, options);
    const OffscreenContext context;
    Renderer renderer;
    const auto drawn = std::make_shared<DrawnSurface>(prepare_drawing(surface));
    std::vector<Picture> pictures;
    for (const PictureOptions& options : views)
        pictures.push_back(drawn_picture(renderer, drawn, options));
    return pictures;
}

Picture draw(const Surface& surface, const PictureOptions& options) {
    return std::move(draw_views(surface, std::span(&options, 1)).front());
}

}  // namespace vesselbench
