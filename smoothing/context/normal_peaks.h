#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Faces that count: unit normals, and areas [mm^2].
struct FaceNormals {
    std::vector<Vec3> normals;
    std::vector<double> areas;
};

/// A direction in which more faces look than the shape around it explains.
struct NormalPeak {
    Vec3 axis = Vec3::UnitZ();  ///< unit, folded
    double faces = 0.0;         ///< within 1 degree
    double excess = 0.0;        ///< of them, beyond what the ring around (2 to 6 degrees) gives
    double area = 0.0;          ///< median area of the faces within 1 degree [mm^2]
};

/// The peak that a direction belongs to: the geometric median of the normals around it.
[[nodiscard]] NormalPeak peak_near(const FaceNormals& faces, const Vec3& start);

/// The highest peaks, 2.5 degrees apart or more, highest excess first.
[[nodiscard]] std::vector<NormalPeak> highest_peaks(const FaceNormals& faces);

/// Voxels as the surface of a mask shows them.
struct VoxelLattice {
    Vec3 long_axis = Vec3::UnitZ();  ///< unit: of the longest voxel edge
    double second_edge = 1.0;        ///< [-] the second longest edge in relation to the longest
    double share = 0.0;              ///< [-] of the faces that fit the lattice
};

/// Recognises a surface whose vertices lie halfway between voxels: nearly all faces look along the
/// three axes or across one or all voxel diagonals. Flat faces are half a voxel side each, which
/// gives the ratios of the edges.
[[nodiscard]] std::optional<VoxelLattice> voxel_lattice(const FaceNormals& faces,
                                                        const std::vector<NormalPeak>& peaks);

}  // namespace vesselbench
