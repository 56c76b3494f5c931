#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gpu/device.h"

namespace vesselbench {

/// Where a user wants something to be computed.
enum class DeviceChoice {
    Auto,  ///< on the device, where that is faster: not on renderers that compute on the CPU
    Cpu,
    Gpu  ///< on whatever offers OpenGL 4.3
};

/// A device with what keeps its context current.
struct HeldDevice {
    std::shared_ptr<void> context;
    Device device;
};

/// Makes a device current on this thread. \throw GpuUnavailable that says what is missing
using DeviceSource = std::function<HeldDevice()>;

/// A context of its own, without a display.
[[nodiscard]] HeldDevice offscreen_device();

/// What came of a choice.
struct ChosenDevice {
    std::optional<HeldDevice> device;  ///< none: the CPU
    std::string reason;  ///< why the CPU serves where it was not asked for; else empty
};

/// The device that serves a choice.
[[nodiscard]] ChosenDevice choose_device(DeviceChoice choice,
                                         const DeviceSource& source = offscreen_device);

}  // namespace vesselbench
