#include "gpu/device_choice.h"

#include "geometry/kernel/errors.h"
#include "gpu/context.h"

namespace vesselbench {

DeviceChoice device_choice_from(const std::string& text) {
    if (text == "auto") return DeviceChoice::Auto;
    if (text == "cpu") return DeviceChoice::Cpu;
    if (text == "gpu") return DeviceChoice::Gpu;
    throw UsageError("device '" + text + "' is unknown: use auto, cpu or gpu");
}

HeldDevice offscreen_device() {
    auto context = std::make_shared<OffscreenContext>();
    return {std::move(context), current_device()};
}

ChosenDevice choose_device(DeviceChoice choice, const DeviceSource& source) {
    if (choice == DeviceChoice::Cpu) return {};
    try {
        HeldDevice held = source();
        require_compute(held.device.limits);
        if (choice == DeviceChoice::Auto && is_software(held.device.limits))
            return {{}, held.device.limits.renderer + " itself computes on the CPU"};
        return {std::move(held), ""};
    } catch (const GpuUnavailable& error) {
        return {{}, error.what()};
    }
}

}  // namespace vesselbench
