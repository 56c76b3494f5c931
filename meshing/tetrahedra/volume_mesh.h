#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

using Tetrahedron = std::array<VertexId, 4>;  ///< positive volume: (b-a) x (c-a) . (d-a) > 0

/// A tetrahedral mesh of the lumen with its boundary triangles (outward) and their patches.
struct VolumeMesh {
    Positions points;  ///< [mm]
    std::vector<Tetrahedron> tetrahedra;
    std::vector<Triangle> boundary;  ///< outward oriented
    PatchLabels boundary_patches;    ///< #boundary, index into patches
    std::vector<Patch> patches;      ///< patches[0] is the wall, then openings, inlet first
};

/// The four faces of a tetrahedron, outward; face i is opposite to corner i.
[[nodiscard]] constexpr std::array<Triangle, 4> faces_of(const Tetrahedron& t) {
    return {{{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}};
}

/// The mesh's boundary as a separate surface, patches included.
[[nodiscard]] Surface boundary_surface(const VolumeMesh& mesh);

/// Sum of the signed volumes of all tetrahedra [mm^3].
[[nodiscard]] double volume(const VolumeMesh& mesh);

}  // namespace vesselbench
