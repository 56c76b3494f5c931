#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "gpu/device_counts.h"
#include "gpu/device_health.h"

namespace vesselbench {

class DeviceStore;

/// The compute capabilities of a context's driver.
struct DeviceLimits {
    int major = 0, minor = 0;               ///< OpenGL version
    std::string renderer;                   ///< the driver's name of the device
    std::size_t largest_storage_block = 0;  ///< [bytes] largest buffer in a shader
    std::size_t largest_group_count = 0;    ///< work groups of one dispatch along its first axis
    std::size_t storage_blocks = 0;         ///< buffers a compute shader may use
    std::size_t largest_view = 0;           ///< texels of a buffer that is read as a texture
};

/// Commands whose failure OpenGL reports later, if at all.
enum class DeviceCommand { Allocate, Copy, Fill, Dispatch, Read };

/// The context that is current on this thread, whoever created it (an OffscreenContext, a window),
/// as computing uses it. A value, whose copies share what a context has once; tests change its
/// members to simulate failures. That context, or one that shares its objects, must be current when
/// the last copy is destroyed.
struct Device {
    DeviceLimits limits;
    /// Texts of the shaders by file name.
    const std::map<std::string, std::string>* shaders = nullptr;
    /// True when the driver has lost the context, or none is current on this thread.
    std::function<bool()> lost;
    /// Surfaces whose vertices do not follow the mesh are reordered (DeviceOrder). False: to
    /// compare.
    bool reorders = true;
    /// Asked before each command, by tests: true if it is to fail. Null: none fails by intent.
    std::function<bool(DeviceCommand)> fails;
    std::shared_ptr<DeviceHealth> health = std::make_shared<DeviceHealth>();
    std::shared_ptr<DeviceCounts> counts = std::make_shared<DeviceCounts>();
    std::shared_ptr<DeviceStore> store = {};
};

/// The device of the current context.
/// \throw GpuUnavailable if it cannot compute, as require_compute
[[nodiscard]] Device current_device();

/// \throw GpuUnavailable that names what the driver lacks: OpenGL 4.3, or the work groups and
/// storage buffers that OpenGL 4.3 guarantees
void require_compute(const DeviceLimits& limits);

/// \throw GpuUnavailable if the context was lost, a command has failed, or the context that is
/// current shares no objects with the device's; then ever after
void require_context(const Device& device);

/// True for renderers that compute on the CPU (llvmpipe, softpipe, SwiftShader): vesselbench's own
/// CPU code is faster than these.
[[nodiscard]] bool is_software(const DeviceLimits& limits);

/// The same of the current context, which need not be able to compute.
[[nodiscard]] bool draws_in_software();

}  // namespace vesselbench
