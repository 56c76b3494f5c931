#pragma once

#include <memory>
#include <string>

namespace vesselbench {

/// What contexts have in common: buffers and programs, or nothing.
enum class Sharing { None, WithCurrent };

/// An OpenGL 4.3 core context without a display (EGL: a real device, else Mesa's surfaceless
/// platform), current on the thread that made it until it is released or goes; then the one that
/// was current before is so again. It has no default framebuffer: draw into a Framebuffer.
class OffscreenContext {
public:
    /// \throw GpuUnavailable that says what is missing: no EGL, no platform, no OpenGL 4.3
    OffscreenContext() : OffscreenContext(Sharing::None) {}

    /// \param sharing WithCurrent: buffers and programs are those of the context that is current on
    /// this thread, a window's for instance, so that another thread can compute what it draws
    /// \throw GpuUnavailable as above, or if there is no current context of EGL to share with
    explicit OffscreenContext(Sharing sharing);
    ~OffscreenContext();
    OffscreenContext(OffscreenContext&&) noexcept;
    OffscreenContext& operator=(OffscreenContext&&) noexcept;

    /// Makes the one current again that was so before, if this one is current on this thread.
    void release();

    /// Makes it current on this thread; it must have been released by the last one.
    /// \throw GpuUnavailable if that fails
    void make_current();

    /// The driver's name, for reports ("llvmpipe (LLVM 15.0.6, 256 bits)").
    [[nodiscard]] std::string renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
