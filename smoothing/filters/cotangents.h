#pragma once

#include <array>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Cotangents of the angles at the corners of every triangle, clamped to [0, 20]: an obtuse angle's
/// negative weight makes the flow unstable. #T
using Cotangents = std::vector<std::array<double, 3>>;

/// \param cotangents resized to #T and overwritten
void find_cotangents(const Topology& topology, const Positions& positions, Cotangents& cotangents);

/// The cotangent-weighted mean of the neighbours less the own position; 0 where all weights are 0.
/// Source: thesis Eq. 3.2 with (u_j - v_i); Desbrun et al., "Implicit fairing", 1999.
[[nodiscard]] Vec3 cotangent_umbrella(const Topology& topology, const Positions& positions,
                                      const Cotangents& cotangents, VertexId v);

/// Curvatures at a vertex of the discrete operators.
struct VertexCurvature {
    double mean = 0.0;   ///< H [1/mm], positive where the surface is convex (outward triangles)
    double gauss = 0.0;  ///< K [1/mm^2]
};

/// Both curvatures at every vertex, unclamped; 0 at boundary vertices and where triangles are
/// degenerate.
/// Source: Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds",
/// 2003, Eqs. 7-9.
[[nodiscard]] std::vector<VertexCurvature> vertex_curvatures(const Topology& topology,
                                                             const Positions& positions);

}  // namespace vesselbench
