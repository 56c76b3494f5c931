#pragma once

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

struct OptimiseParameters {
    int rounds = 4;         ///< rounds of exchanges and moves
    int moves = 3;          ///< sweeps of vertex moves in each round
    double exchange = 2.0;  ///< cells of higher energy are tried for exchanges [-], 1 is regular
    std::size_t largest_ring = 8;  ///< edges with more cells around them are skipped
};

struct OptimiseReport {
    std::size_t exchanges = 0;  ///< groups of cells replaced
    std::size_t moves = 0;      ///< vertex moves
};

/// Improves the cells' shapes without touching the boundary: inner vertices move, edges and faces
/// are exchanged if that lowers the sum of the cells' energies
///     e = 1 / (mean ratio)^3 = (sum of squared edges)^3 / (15552 V^2),  1 for a regular
///     tetrahedron.
/// No cell becomes inverted. Deterministic.
/// Sources: Klingner & Shewchuk, "Aggressive tetrahedral mesh improvement", 2007 (exchanges);
/// Knupp, "Algebraic mesh quality metrics", 2001 (mean ratio).
/// \param mesh in_space_order, or most of the work is left to one thread
[[nodiscard]] VolumeMesh optimised(const VolumeMesh& mesh, const OptimiseParameters& parameters,
                                   const Progress& progress, OptimiseReport* report = nullptr);

}  // namespace vesselbench
