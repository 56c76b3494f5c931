#pragma once

#include <vector>

#include "gpu/device_surface.h"
#include "smoothing/context/caps.h"

namespace vesselbench {

/// Finds the same caps as find_caps(surface), mostly on the device: normals of triangles, flat
/// vertices, their connected parts, and which of these are planar and large enough. Only the
/// vertices of those few parts are read back. Growing them to the surrounding edges, and checking
/// that the surface drops beyond these all around, is sequential: the CPU does it, for these parts
/// only. Thresholds are decided in double precision; normals summed for a part's plane are rounded
/// to 1e-9.
/// \throw InvalidInput if a parameter is out of range; GpuUnavailable if the context is lost,
/// a shader does not compile or a buffer does not fit
[[nodiscard]] std::vector<Cap> find_caps(const DeviceSurface& surface,
                                         const CapParameters& parameters = {});

}  // namespace vesselbench
