#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gpu/device.h"

namespace vesselbench {

/// Where the user wants a computation to run.
enum class DeviceChoice {
    Auto,  ///< on the device if that is faster: not on renderers that compute on the CPU
    Cpu,
    Gpu  ///< on any device with OpenGL 4.3
};

/// \throw UsageError unless "auto", "cpu" or "gpu"
[[nodiscard]] DeviceChoice device_choice_from(const std::string& text);

/// A device and the owner of its context.
struct HeldDevice {
    std::shared_ptr<void> context;
    Device device;
};

/// Makes a device current on this thread. \throw GpuUnavailable that says what is missing
using DeviceSource = std::function<HeldDevice()>;

/// A new context without a display.
[[nodiscard]] HeldDevice offscreen_device();

/// Outcome of a choice.
struct ChosenDevice {
    std::optional<HeldDevice> device;  ///< none: the CPU
    std::string reason;                ///< why it falls back to the CPU; else empty
};

/// Finds the device for a choice.
[[nodiscard]] ChosenDevice choose_device(DeviceChoice choice,
                                         const DeviceSource& source = offscreen_device);

}  // namespace vesselbench
