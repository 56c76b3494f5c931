#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"

namespace vesselbench {

/// Parameters of the mean curvature flow.
struct MeanCurvatureFlowParameters {
    double lambda = 0.5;  ///< step [-], 0 <= lambda <= 1
};

/// Laplace with cotangent weights: vertices move along the curvature normal, with little tangential
/// motion however irregular the triangles are. Shrinks. The weights follow the moving surface.
/// Cotangents are clamped to [0, 20]. Bit-identical for any number of threads.
/// Source: thesis Eq. 3.2 (with u_j - v_i); Desbrun et al., "Implicit fairing of irregular meshes
/// using diffusion and curvature flow", SIGGRAPH 1999.
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput if a parameter is out of its range, the settings do not fit the topology, or
/// rings is not 1: the weights belong to edges
[[nodiscard]] Positions mean_curvature_flow(const Topology& topology, const Positions& positions,
                                            const MeanCurvatureFlowParameters& parameters = {},
                                            const FilterSettings& settings = {},
                                            const Progress& progress = {});

}  // namespace vesselbench
