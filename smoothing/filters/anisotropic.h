#pragma once

#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"

namespace vesselbench {

/// Parameters of anisotropic smoothing.
struct AnisotropicParameters {
    double lambda = 0.5;  ///< step [-], 0 <= lambda <= 1
    /// Principal curvature above which an edge counts as a feature [1/mm], > 0; default: 0.5 over
    /// the surface's mean edge length, a bend of about 30 degrees per edge.
    std::optional<double> feature_curvature = {};
};

/// Default of AnisotropicParameters::feature_curvature [1/mm].
[[nodiscard]] double default_feature_curvature(const Topology& topology,
                                               const Positions& positions);

/// Mean curvature flow that acts along features but not across them: for surfaces of implants,
/// whose sharp edges are real. On anatomy it preserves the staircases. The flow is scaled by
/// smallest principal over mean curvature at edges, by 0 at corners, by 1 elsewhere, clamped to [0,
/// 1]. Bit-identical for any number of threads.
/// Source: Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds",
/// 2003, section 6; thesis 6.3.6.
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput as mean_curvature_flow
[[nodiscard]] Positions anisotropic(const Topology& topology, const Positions& positions,
                                    const AnisotropicParameters& parameters = {},
                                    const FilterSettings& settings = {},
                                    const Progress& progress = {});

}  // namespace vesselbench
