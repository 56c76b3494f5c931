#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

using Tetrahedron = std::array<VertexId, 4>;  ///< positive volume: (b-a) x (c-a) . (d-a) > 0

/// A cell of a wall layer: a triangle towards the wall, seen from which 0, 1, 2 run
/// counter-clockwise, and below its corners those of the inner one, 3, 4, 5. The order of VTK's
/// wedge.
using Prism = std::array<VertexId, 6>;

using Quadrilateral = std::array<VertexId, 4>;  ///< corners in order

/// A mesh of the lumen with its boundary faces (outward) and their patches: tetrahedra, and prisms
/// where the wall has layers. Cells are numbered tetrahedra first.
struct VolumeMesh {
    Positions points;  ///< [mm]
    std::vector<Tetrahedron> tetrahedra;
    std::vector<Triangle> boundary;  ///< outward oriented
    PatchLabels boundary_patches;    ///< #boundary, index into patches
    std::vector<Patch> patches;      ///< patches[0] is the wall, then openings, inlet first
    std::vector<Prism> prisms = {};
    std::vector<Quadrilateral> boundary_sides = {};  ///< of prisms, in openings; outward oriented
    PatchLabels side_patches = {};                   ///< #boundary_sides, index into patches

    [[nodiscard]] std::size_t cell_count() const { return tetrahedra.size() + prisms.size(); }
};

/// The corners of a face of a cell, in order: three, or four.
class FaceCorners {
public:
    constexpr FaceCorners() = default;

    // NOLINTNEXTLINE(google-explicit-constructor): a triangle is one
    constexpr FaceCorners(const Triangle& t) : corners_{t[0], t[1], t[2], t[2]}, count_(3) {}

    // NOLINTNEXTLINE(google-explicit-constructor)
    constexpr FaceCorners(const Quadrilateral& q) : corners_(q), count_(4) {}

    [[nodiscard]] constexpr std::size_t size() const { return count_; }

    [[nodiscard]] constexpr VertexId operator[](std::size_t k) const { return corners_[k]; }

    [[nodiscard]] constexpr const VertexId* begin() const { return corners_.data(); }

    [[nodiscard]] constexpr const VertexId* end() const { return corners_.data() + count_; }

private:
    Quadrilateral corners_{};
    std::uint8_t count_ = 0;
};

/// The four faces of a tetrahedron, outward; face i is opposite to corner i.
[[nodiscard]] constexpr std::array<Triangle, 4> faces_of(const Tetrahedron& t) {
    return {{{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}};
}

/// The five faces of a prism, outward: the one towards the wall, the inner one, and the sides.
[[nodiscard]] constexpr std::array<FaceCorners, 5> faces_of(const Prism& p) {
    return {Triangle{p[0], p[1], p[2]}, Triangle{p[3], p[5], p[4]},
            Quadrilateral{p[0], p[3], p[4], p[1]}, Quadrilateral{p[1], p[4], p[5], p[2]},
            Quadrilateral{p[2], p[5], p[3], p[0]}};
}

/// Normal of a face scaled by twice its area [mm^2]; of a quadrilateral that is not flat, the mean
/// over it.
[[nodiscard]] Vec3 face_normal(const Positions& points, const FaceCorners& face);

/// Volume [mm^3] of a prism whose sides are divided at their middles, as OpenFOAM divides them.
[[nodiscard]] double prism_volume(const Positions& points, const Prism& prism);

/// The mesh's boundary as a separate surface, patches included; quadrilaterals are divided into two
/// triangles each.
[[nodiscard]] Surface boundary_surface(const VolumeMesh& mesh);

/// Sum of the signed volumes of all cells [mm^3].
[[nodiscard]] double volume(const VolumeMesh& mesh);

}  // namespace vesselbench
