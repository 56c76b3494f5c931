#pragma once

#include "geometry/surface.h"
#include "gpu/device_choice.h"
#include "smoothing/filter.h"

namespace vesselbench {

/// Moved positions, and who moved them.
struct DeviceRun {
    Positions positions;      ///< [mm], #V x 3
    bool on_gpu = false;      ///< false: by the CPU, with apply_filter's bits
    std::string device_name;  ///< the driver's name; empty on the CPU
    std::string reason;       ///< why the CPU serves where it was not asked for; else empty
};

/// Runs a filter where the choice says. Whatever fails on the device, now or half-way (no driver,
/// an older version, a shader, memory, a lost context), the CPU runs the filter from the start
/// instead. \param surface at its start \throw InvalidInput as the filter; Cancelled
[[nodiscard]] DeviceRun apply_filter_on(DeviceChoice choice, const Surface& surface,
                                        const FilterParameters& parameters,
                                        const FilterSettings& settings = {},
                                        const Progress& progress = {},
                                        const DeviceSource& source = offscreen_device);

}  // namespace vesselbench
