#pragma once

#include <cstddef>

#include <epoxy/gl.h>

namespace vesselbench::test {

/// As long as it lives, the device does not complete what it is asked to.
class SlowDevice {
public:
    SlowDevice() : before_(epoxy_glClientWaitSync) {
        epoxy_glClientWaitSync = [](GLsync, GLbitfield, GLuint64) -> GLenum {
            return GL_TIMEOUT_EXPIRED;
        };
    }

    ~SlowDevice() { epoxy_glClientWaitSync = before_; }

    SlowDevice(const SlowDevice&) = delete;
    SlowDevice& operator=(const SlowDevice&) = delete;

private:
    PFNGLCLIENTWAITSYNCPROC before_;
};

/// As long as it lives, the device has no memory for new buffers and framebuffers.
class FullDevice {
public:
    FullDevice() : error_(epoxy_glGetError), status_(epoxy_glCheckFramebufferStatus) {
        epoxy_glGetError = []() -> GLenum { return GL_OUT_OF_MEMORY; };
        epoxy_glCheckFramebufferStatus = [](GLenum) -> GLenum {
            return GL_FRAMEBUFFER_UNSUPPORTED;
        };
    }

    ~FullDevice() {
        epoxy_glGetError = error_;
        epoxy_glCheckFramebufferStatus = status_;
    }

    FullDevice(const FullDevice&) = delete;
    FullDevice& operator=(const FullDevice&) = delete;

private:
    PFNGLGETERRORPROC error_;
    PFNGLCHECKFRAMEBUFFERSTATUSPROC status_;
};

}  // namespace vesselbench::test
