#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Coordinates in which a hole is filled: both maps undo each other near the surface.
struct HoleChart {
    std::function<Vec3(const Vec3&)> to_chart;    ///< [mm]
    std::function<Vec3(const Vec3&)> from_chart;  ///< [mm]
};

/// A surface with one hole less; what is new stands at the end of its arrays.
struct FilledHole {
    Surface surface;
    std::size_t first_new_vertex = 0;
    std::size_t first_new_triangle = 0;
};

/// Closes a border loop: triangulation of least area and angle, refined to the density around it,
/// faired to continue the surface (CGAL triangulate_refine_and_fair_hole). The new triangles get
/// the label of the triangle at the loop's first edge, attributes are taken over from the nearest
/// loop vertex.
/// Source: Liepa, "Filling holes in meshes", SGP 2003; Botsch and Kobbelt, "An intuitive framework
/// for real-time freeform modeling", SIGGRAPH 2004.
/// \param loop as Topology::boundary_loops gives it
/// \param continuity at the loop: 0 position, 1 tangent, 2 curvature
/// \param chart if given, triangulated, refined and faired in these coordinates; the first one
/// points
///        out of the wall: the new wall has one value of it for each pair of the others
/// \throw AlgorithmFailure if the hole cannot be triangulated; the text names its place
[[nodiscard]] FilledHole fill_hole(const Surface& surface, std::span<const VertexId> loop,
                                   int continuity = 1, const HoleChart* chart = nullptr);

/// Centre of a loop's edges [mm].
[[nodiscard]] Vec3 loop_centre(const Surface& surface, std::span<const VertexId> loop);

}  // namespace vesselbench
