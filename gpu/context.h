#pragma once

#include <memory>
#include <string>

namespace vesselbench {

/// An OpenGL 4.3 core context without a display (EGL: a real device, else Mesa's surfaceless
/// platform), current on the thread that made it until it goes; then the one that was current
/// before is so again. It has no default framebuffer: draw into a Framebuffer.
class OffscreenContext {
public:
    /// \throw GpuUnavailable that says what is missing: no EGL, no platform, no OpenGL 4.3
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(OffscreenContext&&) noexcept;
    OffscreenContext& operator=(OffscreenContext&&) noexcept;

    /// The driver's name, for reports ("llvmpipe (LLVM 15.0.6, 256 bits)").
    [[nodiscard]] std::string renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
