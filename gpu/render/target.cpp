#include "gpu/render/target.h"

#include <cstddef>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/drawing_errors.h"

namespace vesselbench {

namespace {

Framebuffer make_framebuffer() {
    unsigned id = 0;
    glGenFramebuffers(1, &id);
    return Framebuffer(id);
}

Texture make_texture(int width, int height) {
    unsigned id = 0;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, 0);
    return Texture(id);
}

Picture read_back(int width, int height) {
    Picture picture{width, height, {}};
    const auto row = static_cast<std::size_t>(width) * 3;
    std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    for (int y = height - 1; y >= 0; --y) {
        const auto* first = upside_down.data() + static_cast<std::size_t>(y) * row;
        picture.rgb.insert(picture.rgb.end(), first, first + row);
    }
    return picture;
}

void require_complete() {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GpuUnavailable("the device offers no framebuffer for a picture of this size");
}

}  // namespace

RenderTarget::RenderTarget(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples) {
    allocate();
}

void RenderTarget::allocate() {
    frame_ = make_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    colour_ = make_renderbuffer(GL_RGBA8, width_, height_, samples_);
    depth_ = make_renderbuffer(GL_DEPTH24_STENCIL8, width_, height_, samples_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              depth_.id());
    require_complete();
    resolved_frame_ = make_framebuffer();
    resolved_ = make_texture(width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_frame_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolved_.id(), 0);
    require_complete();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RenderTarget::resize(int width, int height, int samples) {
    if (width == width_ && height == height_ && samples == samples_) return;
    *this = RenderTarget(width, height, samples);
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
}

unsigned RenderTarget::resolve() {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_frame_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return resolved_.id();
}

Picture RenderTarget::picture() {
    resolve();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_frame_.id());
    Picture picture = read_back(width_, height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    require_drawn("a picture");
    return picture;
}

}  // namespace vesselbench
