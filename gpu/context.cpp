#include "gpu/context.h"

#include <array>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "geometry/errors.h"

namespace vesselbench {

namespace {

/// Real devices before Mesa's surfaceless platform, which may be a renderer on the CPU.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> found;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(devices.size(), devices.data(), &count))
            for (EGLint i = 0; i < count; ++i) {
                const char* kind = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
                if (kind != nullptr && std::string(kind).find("software") == std::string::npos)
                    found.push_back(
                        eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
            }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        found.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return found;
}

EGLContext make_context(EGLDisplay display) {
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    eglBindAPI(EGL_OPENGL_API);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
}

}  // namespace

struct OffscreenContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    /// What was current before.
    EGLDisplay last_display = eglGetCurrentDisplay();
    EGLContext last_context = eglGetCurrentContext();
    EGLSurface last_draw = eglGetCurrentSurface(EGL_DRAW),
               last_read = eglGetCurrentSurface(EGL_READ);

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl() {
        if (context == EGL_NO_CONTEXT) return;
        if (last_context != EGL_NO_CONTEXT)
            eglMakeCurrent(last_display, last_draw, last_read, last_context);
        else
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }

    bool use(EGLDisplay candidate) {
        if (candidate == EGL_NO_DISPLAY || !eglInitialize(candidate, nullptr, nullptr))
            return false;
        const EGLContext made = make_context(candidate);
        if (made == EGL_NO_CONTEXT) return false;
        if (!eglMakeCurrent(candidate, EGL_NO_SURFACE, EGL_NO_SURFACE, made)) {
            eglDestroyContext(candidate, made);
            return false;
        }
        display = candidate;
        context = made;
        return true;
    }
};

OffscreenContext::OffscreenContext() : impl_(std::make_unique<Impl>()) {
    const std::vector<EGLDisplay> candidates = displays();
    if (candidates.empty())
        throw GpuUnavailable(
            "EGL has neither a device nor the surfaceless platform here (Debian: libegl-mesa0, "
            "libgl1-mesa-dri)");
    for (EGLDisplay candidate : candidates)
        if (impl_->use(candidate)) return;
    throw GpuUnavailable(
        "no driver offers an OpenGL 4.3 core context without a display (Debian: libgl1-mesa-dri)");
}

OffscreenContext::~OffscreenContext() = default;
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;

std::string OffscreenContext::renderer() const {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace vesselbench
