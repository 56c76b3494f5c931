#include "gpu/context.h"

#include <array>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// epoxy ends the program at its first call if a machine has no EGL at all.
void require_egl() {
    static const bool there = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL) != nullptr;
    if (!there) throw GpuUnavailable("there is no EGL (Debian: libegl1, libgl1-mesa-dri)");
}

/// Real devices before Mesa's surfaceless platform, which may render on the CPU.
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

/// What is asked of a new context, beside its version.
struct Wishes {
    EGLContext shared = EGL_NO_CONTEXT;
    bool debug = false;
};

EGLContext make_context(EGLDisplay display, const Wishes& wishes, bool tells_resets) {
    std::vector<EGLint> wanted = {
        EGL_CONTEXT_MAJOR_VERSION,       4,
        EGL_CONTEXT_MINOR_VERSION,       3,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (tells_resets) {
        wanted.push_back(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY);
        wanted.push_back(EGL_LOSE_CONTEXT_ON_RESET);
    }
    if (wishes.debug && epoxy_egl_version(display) >= 15) {
        wanted.push_back(EGL_CONTEXT_OPENGL_DEBUG);
        wanted.push_back(EGL_TRUE);
    }
    wanted.push_back(EGL_NONE);
    eglBindAPI(EGL_OPENGL_API);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, wishes.shared, wanted.data());
}

/// A context that reports when the driver has lost it (glGetGraphicsResetStatus), if the driver
/// can.
EGLContext make_context(EGLDisplay display, const Wishes& wishes) {
    const EGLContext context =
        epoxy_egl_version(display) >= 15 ? make_context(display, wishes, true) : EGL_NO_CONTEXT;
    return context != EGL_NO_CONTEXT ? context : make_context(display, wishes, false);
}

/// The context current on this thread.
struct Current {
    EGLDisplay display = eglGetCurrentDisplay();
    EGLContext context = eglGetCurrentContext();
    EGLSurface draw = eglGetCurrentSurface(EGL_DRAW), read = eglGetCurrentSurface(EGL_READ);

    /// \param other the display of the context that is current now
    void restore(EGLDisplay other) const {
        if (context != EGL_NO_CONTEXT)
            eglMakeCurrent(display, draw, read, context);
        else
            eglMakeCurrent(other, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
};

/// What a display offers at best: "OpenGL 3.3 (Core Profile) Mesa 22.3.6 on llvmpipe".
std::string best_version(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return "";
    eglBindAPI(EGL_OPENGL_API);
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
    if (context == EGL_NO_CONTEXT) return "";
    std::string text;
    const Current before;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        text = "OpenGL " + std::string(reinterpret_cast<const char*>(glGetString(GL_VERSION))) +
               " on " + reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        before.restore(display);
    }
    eglDestroyContext(display, context);
    return text;
}

/// What there is instead of OpenGL 4.3, for the error's text.
std::string found_instead(const std::vector<EGLDisplay>& candidates) {
    for (EGLDisplay candidate : candidates)
        if (const std::string found = best_version(candidate); !found.empty())
            return ", only " + found;
    return "";
}

}  // namespace

struct OffscreenContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    Current before;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl() {
        if (context == EGL_NO_CONTEXT) return;
        release();
        eglDestroyContext(display, context);
    }

    void release() const {
        if (eglGetCurrentContext() != context) return;
        before.restore(display);
    }

    bool make_current() {
        if (eglGetCurrentContext() != context) before = {};
        eglBindAPI(EGL_OPENGL_API);
        return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
    }

    bool use(EGLDisplay candidate, const Wishes& wishes) {
        if (candidate == EGL_NO_DISPLAY || !eglInitialize(candidate, nullptr, nullptr))
            return false;
        display = candidate;
        context = make_context(candidate, wishes);
        if (context == EGL_NO_CONTEXT) return false;
        if (make_current()) return true;
        eglDestroyContext(display, std::exchange(context, EGL_NO_CONTEXT));
        return false;
    }

    void use_any(bool debug) {
        const std::vector<EGLDisplay> candidates = displays();
        if (candidates.empty())
            throw GpuUnavailable(
                "EGL offers neither a device nor the surfaceless platform (Debian: libegl-mesa0, "
                "libgl1-mesa-dri)");
        for (EGLDisplay candidate : candidates)
            if (use(candidate, {.debug = debug})) return;
        throw GpuUnavailable("no driver offers an OpenGL 4.3 core context without a display" +
                             found_instead(candidates) + " (Debian: libgl1-mesa-dri)");
    }

    void share_with_current(bool debug) {
        if (before.context == EGL_NO_CONTEXT)
            throw GpuUnavailable("there is no EGL context on this thread to share with");
        if (!use(before.display, {before.context, debug}))
            throw GpuUnavailable(
                "the driver cannot create a context that shares with the current one");
    }
};

OffscreenContext::OffscreenContext(Sharing sharing, bool debug) {
    require_egl();
    impl_ = std::make_unique<Impl>();
    if (sharing == Sharing::WithCurrent)
        impl_->share_with_current(debug);
    else
        impl_->use_any(debug);
}

void OffscreenContext::release() {
    impl_->release();
}

void OffscreenContext::make_current() {
    if (!impl_->make_current())
        throw GpuUnavailable("the OpenGL context cannot be made current on this thread");
}

OffscreenContext::~OffscreenContext() = default;
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;

std::string OffscreenContext::renderer() const {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace vesselbench
