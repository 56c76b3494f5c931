#pragma once

#include <memory>

#include "geometry/kernel/progress.h"
#include "gpu/device_surface.h"
#include "smoothing/filters/filter.h"

namespace vesselbench {

/// Like apply_filter, on a device: the same result to single precision.
/// \param there the surface whose connectivity is filtered; its context must be current
/// \param start positions the filter starts from [mm], #V x 3
/// \return moved positions [mm], #V x 3
/// \throw InvalidInput as apply_filter; Cancelled; GpuUnavailable if the device fails, now or
/// midway: a shader does not compile, a buffer does not fit, the context is lost
[[nodiscard]] Positions filter_on_device(const std::shared_ptr<const DeviceSurface>& there,
                                         const std::shared_ptr<const Positions>& start,
                                         const FilterParameters& parameters,
                                         const FilterSettings& settings = {},
                                         const Progress& progress = {});

}  // namespace vesselbench
