#pragma once

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// A flat triangulation of the inside of a closed polygon.
struct FlatCap {
    Positions inner;                  ///< new points [mm], in the plane
    std::vector<Triangle> triangles;  ///< 0 .. #rim - 1 are the rim, #rim ... the inner points;
                                      ///< counter-clockwise around the normal
};

/// Fills a simple polygon with near-equilateral triangles: a constrained Delaunay triangulation of
/// the rim (its edges stay undivided) and of a triangular lattice inside, relaxed.
/// \param rim corners in the plane [mm], counter-clockwise around the plane's normal
/// \param edge target edge length inside [mm]
/// \throw AlgorithmFailure if the polygon touches or crosses itself, or has fewer than 3 corners
[[nodiscard]] FlatCap fill_flat(const Positions& rim, const Plane& plane, double edge);

}  // namespace vesselbench
