#pragma once

#include <memory>

#include "gpu/render/layers.h"

namespace vesselbench {

/// Draws layers with OpenGL 4.3 core into whatever framebuffer is bound, which must have a depth
/// buffer and, for sections, a stencil buffer. Programs are compiled on first use, once. The
/// context of construction must be current whenever it is used or destroyed. It leaves blending,
/// depth test, scissor, stencil and clip distances off, and no program or vertex array bound.
class Renderer {
public:
    /// \throw GpuUnavailable if the device is out of memory
    Renderer();
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Clears the view's rectangle with its background and draws the layers.
    /// \throw GpuUnavailable if a shader does not compile; InvalidInput as ViewCamera
    void draw(const SceneView& view, const Layers& layers);

    /// Draws ids instead of colours: of every pixel {layer id, element, bits of the depth beyond
    /// the centre's plane [mm], kind of layer (PickKind)} into a framebuffer of unsigned integers
    /// (RGBA32UI) that is bound and has the size of `region`, a part of the view's rectangle. For
    /// Picker.
    void draw_ids(const SceneView& view, const Layers& layers, const PixelRectangle& region);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
