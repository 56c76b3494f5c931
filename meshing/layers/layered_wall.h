#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The wall of a closed surface, on which layers grow: all of it but its openings.
struct LayeredWall {
    Surface wall;                        ///< a part of the surface, open at the rims of openings
    std::vector<VertexId> origins;       ///< vertex of the surface, #V, ascending
    std::vector<TriangleId> triangles;   ///< triangle of the surface, #T, ascending
    std::vector<std::uint16_t> opening;  ///< patch whose rim a vertex is on; 0: none. #V
    Positions planes;                    ///< unit normal of each patch's plane, zero of a wall's
    Positions normals;                   ///< outward, weighted by the angles of the wall, #V

    /// True for the patches that flow enters or leaves: they get no layers.
    [[nodiscard]] static bool is_opening(const Patch& patch) {
        return patch.kind == PatchKind::Inlet || patch.kind == PatchKind::Outlet;
    }
};

/// \param surface closed
/// \throw InvalidInput if two openings meet, one is not flat, or all of the surface is an opening
[[nodiscard]] LayeredWall layered_wall(const Surface& surface);

/// What lies in the plane of the opening at whose rim a vertex is; elsewhere the vector itself.
[[nodiscard]] Vec3 in_opening(const LayeredWall& wall, VertexId v, const Vec3& vector);

}  // namespace vesselbench
