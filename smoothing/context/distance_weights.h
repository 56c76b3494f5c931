#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How distances to neighbouring structures become weights (thesis 5.2, Fig. 5.3).
enum class DistanceScaling {
    Linear,      ///< (d - min) / (max - min)
    Margin,      ///< 0 up to the margin, then (d - margin) / (max - margin)
    Exponential  ///< Eq. 5.2
};

/// Parameters of distance awareness (thesis 5.2).
struct DistanceParameters {
    DistanceScaling scaling = DistanceScaling::Linear;
    double margin = 2.0;  ///< safety margin [mm], >= 0
    double omega = 0.06;  ///< [1/mm], > 0
};

/// Distance of every position to the nearest of several neighbours [mm]: exact distances from point
/// to triangle; 0 inside a closed neighbour.
/// \throw InvalidInput if there is no neighbour, or one without triangles
[[nodiscard]] std::vector<double> neighbour_distances(const Positions& positions,
                                                      std::span<const Surface> neighbours);

/// Smoothing weights in [0, 1] that preserve the surface near a neighbour: 0 at the smallest
/// distance or within the margin, 1 at the largest. All 0 if all distances are equal, or none
/// exceeds the margin.
/// Source: thesis 5.2, Eq. 5.2 with d in mm.
/// \throw InvalidInput if a parameter is out of range or a distance is negative or not finite
[[nodiscard]] std::vector<double> distance_weights(std::span<const double> distances,
                                                   const DistanceParameters& parameters = {});

/// \throw InvalidInput if there is no neighbour, or one without triangles
void require_neighbours(std::span<const Surface> neighbours);

/// True if no edge has exactly one triangle, so that a neighbour has an inside.
[[nodiscard]] bool is_closed(const Surface& neighbour);

/// \throw InvalidInput if a parameter is out of range
void require_distance_parameters(const DistanceParameters& parameters);

}  // namespace vesselbench
