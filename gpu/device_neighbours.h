#pragma once

#include <span>

#include "gpu/device_surface.h"

namespace vesselbench {

/// Distances of a surface's vertices to neighbouring structures, on the device.
struct NeighbourDistances {
    Buffer distances;                ///< [mm], >= 0: float, #V
    double least = 0.0, most = 0.0;  ///< smallest and largest [mm]
    std::size_t count = 0;           ///< #V of their surface
};

/// Distance of every vertex to the nearest of several neighbours, as in neighbour_distances: from
/// point to triangle, 0 inside a closed neighbour; single precision. The CPU builds and uploads a
/// tree of each neighbour's triangles; the device searches it.
/// \throw InvalidInput if there is no neighbour, or one without triangles; GpuUnavailable if the
/// context is lost, a shader does not compile or a tree does not fit
[[nodiscard]] NeighbourDistances find_neighbour_distances(const DeviceSurface& surface,
                                                          std::span<const Surface> neighbours);

}  // namespace vesselbench
