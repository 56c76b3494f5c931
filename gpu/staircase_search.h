#pragma once

#include <cstddef>

#include "gpu/device_surface.h"

namespace vesselbench {

/// Distances to staircases on the device.
struct DeviceDistances {
    Buffer distances;         ///< [mm], 3.1e38 where no staircase reaches: float, #V
    double farthest = 0.0;    ///< largest distance of those that are reached [mm]
    std::size_t sources = 0;  ///< staircase vertices
    std::size_t open = 0;     ///< vertices that the CPU had to settle
};

/// Distance of every vertex to the nearest staircase vertex that reaches it (Eq. 5.5), as
/// staircase_distances finds it: in double precision and exact. The device finds the nearest of all
/// staircase vertices in space and a straight walk there, which settles nearly all; what is still
/// open asks its neighbours. Where sheets of the surface come within the reach of each other, only
/// paths one after the other can tell: those few vertices are read back and settled by the CPU.
/// \param changes orientation changes: double, #V
/// \param free_of_caps 0 where a vertex is no staircase anyway: float, #V
/// \param tau_theta,tau_max as in StaircaseParameters
/// \throw GpuUnavailable if the context is lost, a shader does not compile or a buffer does not fit
[[nodiscard]] DeviceDistances search_staircases(const DeviceSurface& surface, const Buffer& changes,
                                                const Buffer& free_of_caps, double tau_theta,
                                                double tau_max);

}  // namespace vesselbench
