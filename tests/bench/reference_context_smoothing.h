#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

/// Context-aware smoothing as InVesalius does it, as a reference for ours; the defaults are those
/// of its dialog.
/// Source: Moench, Adler, Hahmann, Preim, "Staircase-aware smoothing of medical surface meshes",
/// VCBM 2010; Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995. What
/// InVesalius decides beyond them: all three axes of the image, weights inside every step, 0.5 and
/// -0.53 as its factors.
struct ContextSmoothing {
    double angle = 0.7;         ///< least orientation change of a staircase vertex [-]
    double max_distance = 3.0;  ///< range of a staircase's influence [mm], > 0
    double min_weight = 0.5;    ///< weight of everything else [-], 0 to 1
    int steps = 10;             ///< pairs of a shrinking and an inflating step
};

/// 1 at staircases, falling linearly to the least weight at the largest distance; only vertices
/// that a walk within that distance reaches count. #V. Written for clearness: a whole search starts
/// at every staircase vertex.
/// \param axes of the image, unit columns
[[nodiscard]] std::vector<double> context_weights(const Surface& surface,
                                                  const Eigen::Matrix3d& axes,
                                                  const ContextSmoothing& parameters = {});

/// Moved positions [mm], #V x 3. \param weights as from context_weights
[[nodiscard]] Positions context_smoothed(const Surface& surface, const std::vector<double>& weights,
                                         int steps);

}  // namespace vesselbench::bench
