#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace vesselbench {

/// What a context's driver offers, as far as computing needs it.
struct DeviceLimits {
    int major = 0, minor = 0;               ///< OpenGL version
    std::string renderer;                   ///< the driver's name for the device
    std::size_t largest_storage_block = 0;  ///< [bytes] one buffer may have in a shader
    std::size_t largest_group_count = 0;    ///< work groups of one dispatch along its first axis
    std::size_t storage_blocks = 0;         ///< buffers that a compute shader may use
};

/// What computing goes by: the context that is current on this thread, whichever made it (an
/// OffscreenContext, a window). A value; tests change its parts to see what a failure does.
struct Device {
    DeviceLimits limits;
    /// Texts of the shaders by file name.
    const std::map<std::string, std::string>* shaders = nullptr;
    /// True once the driver has lost the context; nothing on the device can be trusted then.
    std::function<bool()> lost;
};

/// The device of the current context.
/// \throw GpuUnavailable if it cannot compute, as require_compute
[[nodiscard]] Device current_device();

/// \throw GpuUnavailable that names what the driver lacks: OpenGL 4.3, or work groups and storage
/// buffers as OpenGL 4.3 promises them
void require_compute(const DeviceLimits& limits);

/// \throw GpuUnavailable if the driver has lost the context since
void require_context(const Device& device);

/// True for renderers that compute on the CPU (llvmpipe, softpipe, SwiftShader): what vesselbench
/// computes there itself is faster.
[[nodiscard]] bool is_software(const DeviceLimits& limits);

}  // namespace vesselbench
