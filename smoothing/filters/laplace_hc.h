#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/linear_parameters.h"

namespace vesselbench {

/// Laplacian smoothing in which every step is pushed back towards the surface before it
/// ("humphrey's classes"): little shrinkage, but large staircases remain. Uniform umbrella operator
/// (Dx)_i = 1/|N(i)| sum_{j in N(i)} (x_j - x_i), negative semidefinite. Bit-identical for any
/// number of threads.
/// Source: Vollmer, Mencl, Mueller, "Improved Laplacian smoothing of noisy surface meshes",
/// Eurographics 1999; thesis Eqs. 3.3-3.6. Weights act on an iteration's displacement after the
/// back-correction (Eq. 5.1).
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput if a parameter is out of its range, or the settings do not fit the topology
[[nodiscard]] Positions laplace_hc(const Topology& topology, const Positions& positions,
                                   const LaplaceHcParameters& parameters = {},
                                   const FilterSettings& settings = {},
                                   const Progress& progress = {});

/// True if the filter amplifies some frequency instead of damping it: (1 - beta) lambda k^2 > 2 for
/// some k in [0, 2] (with alpha = 0 the transfer function is 1 - (1 - beta) lambda k^2).
[[nodiscard]] bool amplifies(const LaplaceHcParameters& parameters);

}  // namespace vesselbench
