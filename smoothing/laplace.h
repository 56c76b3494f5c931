#pragma once

#include <cstdint>
#include <span>

#include "geometry/progress.h"
#include "geometry/topology.h"
#include "geometry/vec3.h"

namespace vesselbench {

/// Parameters of the Laplace filter (thesis Eq. 3.1).
struct LaplaceParameters {
    double lambda = 0.5;                       ///< step [-], 0 <= lambda <= 1
    int iterations = 20;                       ///< >= 0
    bool keep_boundary = true;                 ///< boundary vertices of an open surface stay
    std::span<const std::uint8_t> fixed = {};  ///< 1 where a vertex stays, #V; empty: none
};

/// Moves every vertex towards the mean of its one-ring: smooth, but the surface shrinks.
/// Uniform umbrella operator (Dx)_i = 1/|N(i)| sum_{j in N(i)} (x_j - x_i), negative semidefinite.
/// The same bits on any number of threads.
/// Source: thesis Eq. 3.1; weights as in Eq. 5.1.
/// \param weights per-vertex factor in [0, 1] on each iteration's displacement; empty means 1
/// \return moved positions [mm], #V x 3
/// \throw InvalidInput if a parameter is out of its range, or weights is neither empty nor #V long
[[nodiscard]] Positions laplace(const Topology& topology, const Positions& positions,
                                std::span<const double> weights,
                                const LaplaceParameters& parameters = {},
                                const Progress& progress = {});

}  // namespace vesselbench
