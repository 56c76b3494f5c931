#pragma once

#include <variant>

#include "smoothing/filters/anisotropic.h"
#include "smoothing/filters/curvature_triggered.h"
#include "smoothing/filters/laplace.h"
#include "smoothing/filters/laplace_hc.h"
#include "smoothing/filters/mean_curvature_flow.h"
#include "smoothing/filters/taubin.h"

namespace vesselbench {

/// A filter with its own parameters.
using FilterParameters =
    std::variant<LaplaceParameters, LaplaceHcParameters, TaubinParameters,
                 MeanCurvatureFlowParameters, AnisotropicParameters, CurvatureTriggeredParameters>;

/// Runs the filter that these parameters belong to.
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput as the filter
[[nodiscard]] Positions apply_filter(const Topology& topology, const Positions& positions,
                                     const FilterParameters& parameters,
                                     const FilterSettings& settings = {},
                                     const Progress& progress = {});

}  // namespace vesselbench
