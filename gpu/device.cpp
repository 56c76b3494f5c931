#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/device_store.h"
#include "gpu/shader_texts.h"

namespace vesselbench {

namespace {

constexpr std::size_t kGroups = 65535;     // OpenGL 4.3, table 23.64
constexpr std::size_t kStorageBlocks = 8;  // likewise

std::size_t limit(unsigned name) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return static_cast<std::size_t>(std::max<GLint64>(value, 0));
}

/// Asks the driver for the state of the context that is current now. What it can tell is found
/// once: the list of extensions is long.
std::function<bool()> loss_of_context() {
    const bool of_egl = eglGetCurrentContext() != EGL_NO_CONTEXT;
    const bool tells_resets =
        epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
    return [of_egl, tells_resets] {
        // Without a context every command does nothing, and reports nothing.
        if (of_egl && eglGetCurrentContext() == EGL_NO_CONTEXT) return true;
        return tells_resets && glGetGraphicsResetStatus() != GL_NO_ERROR;
    };
}

void require_at_least(const char* what, std::size_t offered, std::size_t needed) {
    if (offered >= needed) return;
    throw GpuUnavailable("the driver offers " + std::to_string(offered) + " " + what + "; " +
                         std::to_string(needed) + " are required");
}

bool is_software_name(std::string_view renderer) {
    constexpr std::array kNames = {"llvmpipe", "softpipe", "swrast", "SwiftShader",
                                   "Software Rasterizer"};
    return std::ranges::any_of(
        kNames, [&](const char* name) { return renderer.find(name) != std::string_view::npos; });
}

}  // namespace

Device current_device() {
    Device device{
        .limits = {}, .shaders = &shader_texts(), .lost = loss_of_context(), .fails = nullptr};
    const int version = epoxy_gl_version();
    device.limits.major = version / 10;
    device.limits.minor = version % 10;
    device.limits.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (version >= 43) {
        device.limits.largest_storage_block = limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
        device.limits.storage_blocks = limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
        int groups = 0;
        glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups);
        device.limits.largest_group_count = static_cast<std::size_t>(std::max(groups, 0));
        device.limits.largest_view = limit(GL_MAX_TEXTURE_BUFFER_SIZE);
    }
    require_compute(device.limits);
    device.store = std::make_shared<DeviceStore>();
    return device;
}

void require_compute(const DeviceLimits& limits) {
    if (limits.major < 4 || (limits.major == 4 && limits.minor < 3))
        throw GpuUnavailable("the driver offers OpenGL " + std::to_string(limits.major) + "." +
                             std::to_string(limits.minor) +
                             ", but computing requires 4.3: a newer driver may help");
    require_at_least("work groups", limits.largest_group_count, kGroups);
    require_at_least("storage buffers in a shader", limits.storage_blocks, kStorageBlocks);
}

void require_context(const Device& device) {
    if (device.lost())
        device.health->fail("the graphics driver was reset and lost its context");
    else if (!device.store->is_current())
        device.health->fail("another context than the device's is current on this thread");
    if (!device.health->failure().empty()) throw GpuUnavailable(device.health->failure());
}

bool is_software(const DeviceLimits& limits) {
    return is_software_name(limits.renderer);
}

bool draws_in_software() {
    return is_software_name(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
}

}  // namespace vesselbench
