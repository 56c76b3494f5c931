#pragma once

#include <memory>

#include "gpu/device_surface.h"
#include "smoothing/context/context_finder.h"

namespace vesselbench {

/// The finder based on gpu/device_caps, gpu/device_neighbours and GpuWeights: the CPU's caps, and
/// its weights to single precision. The surface's context must be current whenever it is used or
/// destroyed. Throws GpuUnavailable if the context is lost, a shader does not compile or a buffer
/// does not fit.
[[nodiscard]] std::unique_ptr<ContextFinder> make_gpu_finder(
    std::shared_ptr<const DeviceSurface> surface);

}  // namespace vesselbench
