#pragma once

#include <limits>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// The wall that a vertex of the wall faces.
struct FacingWall {
    double distance = 0.0;    ///< along the vertex's normal [mm]
    VertexId from = 0;        ///< the vertex
    Vec3 to = Vec3::Zero();   ///< on the wall that it faces [mm]
    TriangleId triangle = 0;  ///< that contains `to`
};

enum class FacingSide {
    Lumen,   ///< across the inside
    Outside  ///< across a gap
};

/// For each vertex of the wall the wall that it faces: along its normal, with a normal that differs
/// by more than 120 degrees. Rims and caps do not count. Nearest first, ties by vertex.
/// \param search of the same surface
/// \param reach walls farther away do not count [mm]
[[nodiscard]] std::vector<FacingWall> facing_walls(
    const Surface& surface, const SurfaceDistance& search, FacingSide side,
    double reach = std::numeric_limits<double>::infinity());

/// True if both walls belong to one fold, such as the crotch of a furcation: the shortest way
/// between them along the surface's edges is below three times their distance. Two branches are
/// farther apart.
/// \param crease a way so short is a fold at any distance, as across a sharp edge [mm]
[[nodiscard]] bool is_fold(const Surface& surface, const FacingWall& facing, double crease = 0.0);

}  // namespace vesselbench
