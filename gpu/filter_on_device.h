#pragma once

#include <functional>
#include <memory>

#include "geometry/kernel/surface.h"
#include "gpu/device_choice.h"
#include "smoothing/context/context_finder.h"
#include "smoothing/filters/filter.h"

namespace vesselbench {

/// What a filter starts from and heeds.
struct FilterStart {
    std::shared_ptr<const Positions> positions;  ///< [mm], #V x 3
    FilterSettings settings;                     ///< what it refers to outlives the filter's run
};

/// Works out a surface's FilterStart with what finds its context. Called again, for the CPU, where
/// the device fails: nothing of the first call may be left then.
using FilterPreparation = std::function<FilterStart(ContextFinder& finder)>;

/// Moved positions, and who moved them.
struct DeviceRun {
    Positions positions;      ///< [mm], #V x 3
    bool on_gpu = false;      ///< false: by the CPU, with apply_filter's bits
    std::string device_name;  ///< the driver's name; empty on the CPU
    std::string reason;       ///< why the CPU serves where it was not asked for; else empty
};

/// Finds a surface's context and runs a filter where the choice says. Whatever fails on the device,
/// now or half-way (no driver, an older version, a shader, memory, a lost context), the CPU does
/// both from the start instead. \param surface what the finder looks at
/// \param prepare empty: the surface as it is, with default settings
/// \throw InvalidInput as the filter; Cancelled; what `prepare` throws
[[nodiscard]] DeviceRun apply_filter_on(DeviceChoice choice, const Surface& surface,
                                        const FilterParameters& parameters,
                                        const FilterPreparation& prepare = {},
                                        const Progress& progress = {},
                                        const DeviceSource& source = offscreen_device);

}  // namespace vesselbench
