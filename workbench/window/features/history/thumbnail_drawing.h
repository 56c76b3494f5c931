#pragma once

#include "gpu/png.h"
#include "gpu/render/drawing_arrays.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"

namespace vesselbench {

inline constexpr int kThumbnailWidth = 256, kThumbnailHeight = 192;  ///< [pixels]

/// What a thumbnail is drawn from: a rough copy of the surface, so that drawing it takes the same
/// few milliseconds for any surface. For any thread.
/// \throw InvalidInput if the surface is empty
[[nodiscard]] DrawingArrays thumbnail_arrays(const Surface& surface);

/// Draws small pictures of surfaces from the front, on nothing. Needs the window's OpenGL context.
class ThumbnailDrawing {
public:
    ThumbnailDrawing() : target_(kThumbnailWidth, kThumbnailHeight) {}

    [[nodiscard]] ClearPicture draw(Renderer& renderer, DrawingArrays arrays);

private:
    RenderTarget target_;
};

}  // namespace vesselbench
