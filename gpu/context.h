#pragma once

#include <memory>
#include <string>

#include "gpu/debug_output.h"

namespace vesselbench {

/// What contexts share: buffers and programs, or nothing.
enum class Sharing { None, WithCurrent };

/// An OpenGL 4.3 core context without a display (EGL: a real device, else Mesa's surfaceless
/// platform), current on the thread that created it until it is released or destroyed; then the
/// previous one is current again. It has no default framebuffer: draw into a Framebuffer.
class OffscreenContext {
public:
    /// \throw GpuUnavailable that names what is missing: EGL, a platform, or OpenGL 4.3
    OffscreenContext() : OffscreenContext(Sharing::None) {}

    /// \param sharing WithCurrent: shares buffers and programs with the context that is current on
    /// this thread, a window's for instance, so that another thread can compute what it draws
    /// \param debug asks for a debug context; else a driver may report nothing to DebugOutput
    /// \throw GpuUnavailable as above, or if there is no current EGL context to share with
    explicit OffscreenContext(Sharing sharing, bool debug = wants_debug_output());
    ~OffscreenContext();
    OffscreenContext(OffscreenContext&&) noexcept;
    OffscreenContext& operator=(OffscreenContext&&) noexcept;

    /// Restores the context that was current before, if this one is current on this thread.
    void release();

    /// Makes it current on this thread; the previous thread must have released it.
    /// \throw GpuUnavailable if that fails
    void make_current();

    /// The driver's name, for reports ("llvmpipe (LLVM 15.0.6, 256 bits)").
    [[nodiscard]] std::string renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
