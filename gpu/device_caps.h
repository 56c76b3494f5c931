#pragma once

#include <vector>

#include "gpu/device_surface.h"
#include "smoothing/context/caps.h"

namespace vesselbench {

/// Finds the caps of a surface as find_caps(surface) does, and the same ones, most of it on the
/// device: normals of triangles, flat vertices, the connected parts of them, and which of these are
/// plane and large enough. Only the vertices of those few parts are read back. What grows from them
/// up to the edges around, and whether the surface drops behind these all around, follows the
/// surface step by step from area to area: the CPU decides it, and works nothing out for the rest.
/// Thresholds are decided in double precision; normals that are added up to a part's plane are
/// rounded to 1e-9.
/// \throw InvalidInput if a parameter is out of range; GpuUnavailable if the context is lost, a
/// shader does not compile or a buffer does not fit
[[nodiscard]] std::vector<Cap> find_caps(const DeviceSurface& surface,
                                         const CapParameters& parameters = {});

}  // namespace vesselbench
