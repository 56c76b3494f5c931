#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/editing/editable_surface.h"

namespace vesselbench {

/// Coordinates in which a hole is filled: the maps are inverse to each other near the surface.
struct HoleChart {
    std::function<Vec3(const Vec3&)> to_chart;    ///< [mm]
    std::function<Vec3(const Vec3&)> from_chart;  ///< [mm]
};

/// Closes an open rim by the triangulation of least area and angle, refined to the density around
/// it and faired to continue the surface (fill_smoothly, or fill_seen_along_x in a chart). The new
/// triangles get the label of the triangle at the loop's first edge; attributes are copied from the
/// nearest loop vertex.
/// \param loop as from EditableSurface::rims
/// \param continuity at the loop: 0 position, 1 tangent, 2 curvature
/// \param chart if given, the hole is filled and faired in these coordinates; the first one points
///        out of the wall, and the new wall is a function of the other two
/// \return the number of new triangles
/// \throw AlgorithmFailure if the hole cannot be triangulated; the text names its place
std::size_t fill_rim(EditableSurface& surface, std::span<const VertexId> loop, int continuity = 1,
                     const HoleChart* chart = nullptr);

/// A surface with one hole filled; new elements are at the end of its arrays.
struct FilledHole {
    Surface surface;
    std::size_t first_new_vertex = 0;
    std::size_t first_new_triangle = 0;
};

/// The same for a surface that is not edited further.
/// \param loop as from Topology::boundary_loops
[[nodiscard]] FilledHole fill_hole(const Surface& surface, std::span<const VertexId> loop,
                                   int continuity = 1);

/// Centre of a loop's edges [mm].
[[nodiscard]] Vec3 loop_centre(const Surface& surface, std::span<const VertexId> loop);
[[nodiscard]] Vec3 loop_centre(const Positions& corners);

}  // namespace vesselbench
