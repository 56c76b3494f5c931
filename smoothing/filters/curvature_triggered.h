#pragma once

#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"

namespace vesselbench {

/// Parameters of curvature-triggered smoothing.
struct CurvatureTriggeredParameters {
    double lambda = 0.5;  ///< step [-], 0 <= lambda <= 1
    /// Absolute mean curvature above which a vertex moves at once [1/mm], > 0; default: half the
    /// feature curvature of anisotropic smoothing, because an edge bends in one direction only.
    std::optional<double> trigger_curvature = {};
};

/// Default of CurvatureTriggeredParameters::trigger_curvature [1/mm].
[[nodiscard]] double default_trigger_curvature(const Topology& topology,
                                               const Positions& positions);

/// Laplace that starts at sharp places: at first only vertices whose absolute mean curvature
/// exceeds the threshold may move; in every iteration the neighbours of moved vertices join in.
/// Staircases are thus smoothed at their edges first, then gradually around them. Bit-identical for
/// any number of threads.
/// Source: thesis 6.3.6 (its threshold is called lambda there).
/// \return moved positions [mm], #V x 3, in the order of `positions`
/// \throw InvalidInput if a parameter is out of its range, or the settings do not fit the topology
[[nodiscard]] Positions curvature_triggered(const Topology& topology, const Positions& positions,
                                            const CurvatureTriggeredParameters& parameters = {},
                                            const FilterSettings& settings = {},
                                            const Progress& progress = {});

}  // namespace vesselbench
