#pragma once

#include <cstddef>

#include "gpu/device_surface.h"

namespace vesselbench {

/// Inclusive prefix sum on the device: each number becomes the sum of itself and all before it.
/// \param numbers uint; the first `count` are used
/// \throw GpuUnavailable if a shader does not compile or a buffer does not fit
void add_up(const DeviceSurface& surface, const Buffer& numbers, std::size_t count);

}  // namespace vesselbench
