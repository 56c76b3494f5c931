#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/linear_parameters.h"

namespace vesselbench {

/// Moves every vertex towards the mean of its neighbours: smooth, but the surface shrinks. Uniform
/// umbrella operator (Dx)_i = 1/|N(i)| sum_{j in N(i)} (x_j - x_i), negative semidefinite.
/// Bit-identical for any number of threads.
/// Source: thesis Eq. 3.1; weights as in Eq. 5.1.
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput if a parameter is out of its range, or the settings do not fit the topology
[[nodiscard]] Positions laplace(const Topology& topology, const Positions& positions,
                                const LaplaceParameters& parameters = {},
                                const FilterSettings& settings = {}, const Progress& progress = {});

}  // namespace vesselbench
