#pragma once

#include "gpu/objects.h"
#include "gpu/picture_options.h"
#include "gpu/render/layers.h"

namespace vesselbench {

/// A framebuffer of the current context for pictures and parts of a window: colour, depth and
/// stencil with several samples per pixel.
class RenderTarget {
public:
    static constexpr int kSamples = 4;

    /// \param samples per pixel; 0: one, without smooth edges
    /// \throw GpuUnavailable if the device offers no framebuffer of this size
    RenderTarget(int width, int height, int samples = kSamples);

    [[nodiscard]] int width() const { return width_; }

    [[nodiscard]] int height() const { return height_; }

    /// All of it.
    [[nodiscard]] PixelRectangle rectangle() const { return {0, 0, width_, height_}; }

    /// Allocates again if the size or the number of samples differs.
    /// \throw GpuUnavailable as construction
    void resize(int width, int height, int samples = kSamples);

    /// Subsequent drawing goes to it.
    void bind() const;

    /// Averages the samples into a texture (RGBA8, its first row is the lowest) and binds the
    /// default framebuffer. \return the texture's name, for ImGui::Image (upper left (0, 1), lower
    /// right (1, 0))
    unsigned resolve();

    /// resolve(), read back.
    /// \throw GpuUnavailable if a command has failed since the last look at errors: the picture may
    /// lack something
    [[nodiscard]] Picture picture();

private:
    void allocate();

    int width_, height_, samples_;
    Framebuffer frame_, resolved_frame_;
    Renderbuffer colour_, depth_;
    Texture resolved_;
};

}  // namespace vesselbench
