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
    /// Principal curvature from which an edge is a feature [1/mm], > 0; default: 0.5 over the
    /// mean edge length of the surface, a bend of about 30 degrees an edge.
    std::optional<double> feature_curvature = {};
};

/// The default of AnisotropicParameters::feature_curvature [1/mm].
[[nodiscard]] double default_feature_curvature(const Topology& topology,
                                               const Positions& positions);

/// Mean curvature flow that goes along features but not across them: for surfaces of implants,
/// whose sharp edges are real. On anatomy it keeps the staircases. The flow at a vertex is scaled
/// by the smallest principal curvature over the mean curvature where that is an edge, by 0 at
/// corners, by 1 elsewhere; here clamped to [0, 1]. The same bits on any number of threads. Source:
/// Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds", 2003,
/// section 6; thesis 6.3.6. \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput as mean_curvature_flow
[[nodiscard]] Positions anisotropic(const Topology& topology, const Positions& positions,
                                    const AnisotropicParameters& parameters = {},
                                    const FilterSettings& settings = {},
                                    const Progress& progress = {});

}  // namespace vesselbench
