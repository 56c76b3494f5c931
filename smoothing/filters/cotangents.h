#pragma once

#include <array>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Cotangents of the corner angles of every triangle, clamped to [0, 20], because the negative
/// weight of an obtuse angle makes the flow unstable. #T
using Cotangents = std::vector<std::array<double, 3>>;

/// \param cotangents resized to #T and overwritten
void find_cotangents(const Topology& topology, const Positions& positions, Cotangents& cotangents);

/// Cotangent-weighted mean of the neighbours minus the own position; 0 if all weights are 0.
/// Source: thesis Eq. 3.2 with (u_j - v_i); Desbrun et al., "Implicit fairing", 1999.
[[nodiscard]] Vec3 cotangent_umbrella(const Topology& topology, const Positions& positions,
                                      const Cotangents& cotangents, VertexId v);

/// Discrete curvatures at a vertex.
struct VertexCurvature {
    double mean = 0.0;   ///< H [1/mm], positive where the surface is convex (outward triangles)
    double gauss = 0.0;  ///< K [1/mm^2]
};

/// Both curvatures at every vertex, unclamped; 0 at boundary vertices and at degenerate
/// triangles.
/// Source: Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds",
/// 2003, Eqs. 7-9.
[[nodiscard]] std::vector<VertexCurvature> vertex_curvatures(const Topology& topology,
                                                             const Positions& positions);

}  // namespace vesselbench
