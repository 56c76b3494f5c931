#include "workbench/window/features/history/thumbnail_drawing.h"

#include <algorithm>
#include <array>
#include <memory>

#include <epoxy/gl.h>

#include "gpu/picture.h"
#include "gpu/render/drawn_surface.h"
#include "meshing/remeshing/coarse_surface.h"

namespace vesselbench {

namespace {

constexpr int kCells = 64;        ///< of the rough copy: four pixels a cell
constexpr double kMargin = 0.08;  ///< around the model [-]

/// Colours come multiplied by alpha, which is the covered part of a pixel. Pixels without any get
/// the mean colour: where pictures are shrunk, it mixes with its neighbours.
void divide_by_alpha(std::vector<std::uint8_t>& rgba) {
    std::array<std::size_t, 4> sums = {0, 0, 0, 1};
    for (std::size_t i = 0; i < rgba.size(); ++i) sums[i % 4] += rgba[i];
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const std::size_t alpha = rgba[i - i % 4 + 3], part = i % 4;
        if (part == 3) continue;
        const std::size_t full = alpha == 0 ? sums[part] * 255 / sums[3] : rgba[i] * 255 / alpha;
        rgba[i] = static_cast<std::uint8_t>(std::min<std::size_t>(255, full));
    }
}

ClearPicture read_back(unsigned texture) {
    ClearPicture picture{kThumbnailWidth, kThumbnailHeight, {}};
    const std::size_t row = std::size_t{kThumbnailWidth} * 4;
    std::vector<std::uint8_t> upward(row * kThumbnailHeight);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, upward.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    divide_by_alpha(upward);
    for (int y = kThumbnailHeight; y-- > 0;) {
        const auto from = upward.begin() + static_cast<std::ptrdiff_t>(row) * y;
        picture.rgba.insert(picture.rgba.end(), from, from + static_cast<std::ptrdiff_t>(row));
    }
    return picture;
}

}  // namespace

DrawingArrays thumbnail_arrays(const Surface& surface) {
    return prepare_drawing(coarse_surface(surface, kCells));
}

ClearPicture ThumbnailDrawing::draw(Renderer& renderer, DrawingArrays arrays) {
    const auto source = std::make_shared<DrawnSurface>(std::move(arrays));
    const Surface& surface = source->surface();
    SceneView view{.rectangle = target_.rectangle(), .background = std::nullopt};
    view.camera = framed(facing({}, StandardView::Anterior), surface.points(),
                         view.rectangle.aspect(), kMargin);
    SurfaceLayer layer{.source = source, .colouring = Colouring::Patches};
    layer.patch_colours = patch_colours(surface);
    target_.bind();
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    renderer.draw(view, {.surfaces = {std::move(layer)}, .slices = {}, .lines = {}, .points = {}});
    return read_back(target_.resolve());
}

}  // namespace vesselbench
