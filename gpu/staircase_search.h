#pragma once

#include <cstddef>

#include "gpu/device_surface.h"

namespace vesselbench {

/// Distances to staircases on the device.
struct DeviceDistances {
    Buffer distances;         ///< [mm], 3.1e38 where no staircase reaches: float, #V
    double farthest = 0.0;    ///< largest distance of a vertex with a staircase [mm]
    std::size_t sources = 0;  ///< staircase vertices
    std::size_t open = 0;     ///< vertices the CPU had to settle
};

/// Distance of every vertex to the nearest staircase vertex that reaches it (Eq. 5.5), as in
/// staircase_distances: in double precision and exact. The device finds the nearest of all
/// staircase vertices in space and a straight walk to it, which settles nearly all vertices; those
/// still open query their neighbours. Where sheets of the surface come within reach of each other,
/// a sequential search is needed: those few vertices are read back and settled by the CPU.
/// \param changes orientation changes: double, #V
/// \param free_of_caps 0 if a vertex must not be a staircase: float, #V
/// \param tau_theta,tau_max as in StaircaseParameters
/// \throw GpuUnavailable if the context is lost, a shader does not compile or a buffer does not fit
[[nodiscard]] DeviceDistances search_staircases(const DeviceSurface& surface, const Buffer& changes,
                                                const Buffer& free_of_caps, double tau_theta,
                                                double tau_max);

}  // namespace vesselbench
