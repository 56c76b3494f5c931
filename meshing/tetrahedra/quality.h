#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// A face of a polyhedral mesh: its corners, the cell it points out of (owner) and the cell behind
/// it (neighbour), which is `kOutside` at the boundary.
struct MeshFace {
    static constexpr std::uint32_t kOutside = 0xFFFFFFFF;

    FaceCorners corners;  ///< right-hand normal points out of the owner
    std::uint32_t owner = 0;
    std::uint32_t neighbour = kOutside;
    std::uint16_t patch = 0;  ///< at the boundary
};

/// The cells behind the faces of each cell, in the order of faces_of; MeshFace::kOutside at the
/// boundary, and where a tetrahedron has no fifth face. #cells
using CellNeighbours = std::vector<std::array<std::uint32_t, 5>>;

/// \throw InvalidInput if a face has more than two cells, Cancelled
[[nodiscard]] CellNeighbours cell_neighbours(const VolumeMesh& mesh, const Progress& cancel = {});

/// All faces in OpenFOAM's order: inner faces by owner, then by neighbour (upper triangular), then
/// the boundary by patch, then by owner. The owner is the cell with the lower number.
/// \throw InvalidInput if a face has more than two cells, or an outer one is not in the boundary
[[nodiscard]] std::vector<MeshFace> mesh_faces(const VolumeMesh& mesh);

/// The same if the cells' neighbours are known.
[[nodiscard]] std::vector<MeshFace> mesh_faces(const VolumeMesh& mesh,
                                               const CellNeighbours& neighbours);

/// Shape quality of the cells. Non-orthogonality, skewness and aspect ratio are OpenFOAM's
/// (checkMesh of v1912, meshTools/primitiveMeshCheck), so both report the same numbers.
struct VolumeQuality {
    std::size_t points = 0, cells = 0, faces = 0, inner_faces = 0;
    double volume = 0.0;                ///< [mm^3]
    double smallest_cell = 0.0;         ///< [mm^3]; <= 0: an inverted cell
    double mean_edge = 0.0;             ///< [mm]
    double smallest_dihedral = 0.0;     ///< [deg]
    double mean_smallest_dihedral = 0;  ///< mean over the cells of each cell's smallest angle [deg]
    double largest_dihedral = 0.0;      ///< [deg]
    std::size_t cells_below_10_deg = 0;
    double mean_non_orthogonality = 0.0;     ///< of inner faces, by the mean cosine [deg]
    double largest_non_orthogonality = 0.0;  ///< [deg]
    std::size_t faces_over_70_deg = 0;
    double largest_skewness = 0.0;          ///< [-]
    double largest_aspect_ratio = 0.0;      ///< [-]
    double mean_volume_ratio = 1.0;         ///< larger over smaller cell at a face [-]
    double largest_volume_ratio = 1.0;      ///< [-]
    std::size_t prisms = 0;                 ///< of the cells
    double smallest_scaled_jacobian = 1.0;  ///< of the prisms [-]
};

[[nodiscard]] VolumeQuality volume_quality(const VolumeMesh& mesh);

/// The same if the mesh's faces are known.
[[nodiscard]] VolumeQuality volume_quality(const VolumeMesh& mesh, std::span<const MeshFace> faces);

/// Only the largest_non_orthogonality [deg], for known faces.
/// \param faces of mesh_faces
[[nodiscard]] double largest_non_orthogonality(const VolumeMesh& mesh,
                                               std::span<const MeshFace> faces);

/// The six inner angles between the faces of a tetrahedron [deg].
[[nodiscard]] std::array<double, 6> dihedral_angles(const Vec3& a, const Vec3& b, const Vec3& c,
                                                    const Vec3& d);

/// The smallest scaled Jacobian at a prism's corners [-]: the volume spanned by the corner's edges
/// over the product of their lengths, 1 where the base is equilateral and the edge between the
/// triangles perpendicular to it; <= 0: folded.
/// Source: Knupp, "Algebraic mesh quality metrics for unstructured initial meshes", 2003.
[[nodiscard]] double scaled_jacobian(const Positions& points, const Prism& prism);

/// The smallest of these angles of each cell [deg], #cells; a prism's best is 60.
/// \throw Cancelled
[[nodiscard]] std::vector<double> smallest_dihedral_angles(const VolumeMesh& mesh,
                                                           const Progress& progress = {});

}  // namespace vesselbench
