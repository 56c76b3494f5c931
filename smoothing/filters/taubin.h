#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/linear_parameters.h"

namespace vesselbench {

/// Smooths positions without shrinking the surface (the thesis's "LowPass" filter). Uniform
/// umbrella operator (Dx)_i = 1/|N(i)| sum_{j in N(i)} (x_j - x_i), negative semidefinite.
/// Bit-identical for any number of threads.
/// Source: Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995; thesis
/// Eqs. 3.7-3.8. An iteration is a lambda|mu pair; weights act on the displacement of the pair
/// (Eq. 5.1: after the inflating step, not inside it).
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput if a parameter is out of its range, or the settings do not fit the
/// topology
[[nodiscard]] Positions taubin(const Topology& topology, const Positions& positions,
                               const TaubinParameters& parameters = {},
                               const FilterSettings& settings = {}, const Progress& progress = {});

/// True if the filter amplifies the highest frequencies instead of removing them: |f(2)| > 1.
[[nodiscard]] bool amplifies(const TaubinParameters& parameters);

}  // namespace vesselbench
