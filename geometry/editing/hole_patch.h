#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// An open loop and the surface around it.
struct Hole {
    std::vector<VertexId> loop;           ///< in the direction of its triangles' half-edges
    std::vector<Triangle> around;         ///< a few rings of triangles, which guide the fairing
    std::function<Vec3(VertexId)> point;  ///< position of a vertex [mm]
    VertexId first_new = 0;               ///< number of the first new vertex
    /// Whether the filling may reach beyond the loop where another open rim touches it.
    bool fills_touching_rims = false;
};

/// Triangles that fill a hole; new vertices are numbered from Hole::first_new on.
struct HolePatch {
    enum class Result { Filled, NotManifold, NotTriangulated };

    Result result = Result::Filled;
    Positions points;  ///< of the new vertices [mm]
    std::vector<Triangle> triangles;
};

/// Order of the new elements (the two users rely on different ones): as CGAL made them, or as it
/// reported them, vertices by their first triangle.
enum class PatchOrder { AsMade, AsReported };

/// Fills a hole with triangles of the size found at its rim, bent to continue the surface.
/// Source: Liepa, "Filling holes in meshes", SGP 2003; Botsch and Kobbelt, "An intuitive framework
/// for real-time freeform modeling", SIGGRAPH 2004; CGAL's triangulate_refine_and_fair_hole.
/// \param continuity at the loop: 0 position, 1 tangent, 2 curvature
[[nodiscard]] HolePatch fill_smoothly(const Hole& hole, int continuity, PatchOrder order);

/// The same for a hole seen from outside along -x: triangulated by near-equilateral triangles in y
/// and z, then faired out of that plane.
[[nodiscard]] HolePatch fill_seen_along_x(const Hole& hole, int continuity);

/// Fills the loop with triangles between its own vertices only or, if that fails, with a fan around
/// its middle.
[[nodiscard]] HolePatch fill_plainly(const Hole& hole);

/// The triangles within `rings` rings of the loop, ascending.
/// \param triangles_at triangles at a vertex
/// \param corners of a triangle
[[nodiscard]] std::vector<TriangleId> triangles_around(
    std::span<const VertexId> loop, int rings,
    const std::function<std::vector<TriangleId>(VertexId)>& triangles_at,
    const std::function<Triangle(TriangleId)>& corners);

}  // namespace vesselbench
