#pragma once

#include <span>
#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// Triangles between two closed rings of points, matched by the points' fractions of the way
/// around; indices count the lower ring, then the upper one. Outward if the rings run
/// counter-clockwise seen from the upper ring's side.
/// \param lower,upper ascending, over a range of at most 1 [-]
[[nodiscard]] std::vector<Triangle> band_between(std::span<const double> lower,
                                                 std::span<const double> upper);

/// A closed ring of vertices, and each one's fraction of the way around, ascending from 0 to below
/// 1.
struct Ring {
    std::vector<VertexId> vertices;
    std::vector<double> shares;
};

/// Adds the band of triangles between two rings that run the same way around.
void join_rings(EditableSurface& surface, const Ring& lower, const Ring& upper,
                std::uint16_t label);

/// Joins two open rims that face each other by a band of triangles; vertices are matched by arc
/// length from the nearest pair at the first rim's start.
/// \param rim,other as from EditableSurface::rims
void join_rims(EditableSurface& surface, std::span<const VertexId> rim,
               std::span<const VertexId> other, std::uint16_t label);

/// Closes a planar loop by near-equilateral triangles (fill_flat).
/// \param loop in the plane, in the direction of the new half-edges: opposite to the wall's,
///        counter-clockwise around the plane's normal
/// \param edge target edge length inside [mm]
/// \throw AlgorithmFailure if the loop touches or crosses itself
void close_flat(EditableSurface& surface, std::span<const VertexId> loop, const Plane& plane,
                double edge, std::uint16_t label);

}  // namespace vesselbench
