#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "smoothing/context/voxel_grid.h"

namespace vesselbench {

/// The faces that count: unit normals, and areas [mm^2].
struct FaceNormals {
    std::vector<Vec3> normals;
    std::vector<double> areas;
};

/// A direction with more face normals than the surrounding shape explains.
struct NormalPeak {
    Vec3 axis = Vec3::UnitZ();  ///< unit, folded
    double faces = 0.0;         ///< within 1 degree
    double excess = 0.0;        ///< of them, beyond those expected from the ring (2 to 6 degrees)
    double area = 0.0;          ///< median area of the faces within 1 degree [mm^2]
};

/// The peak around a direction: the geometric median of the normals near it.
[[nodiscard]] NormalPeak peak_near(const FaceNormals& faces, const Vec3& start);

/// The highest peaks, at least 2.5 degrees apart, highest excess first.
[[nodiscard]] std::vector<NormalPeak> highest_peaks(const FaceNormals& faces);

/// Voxels as seen in the surface of a mask.
struct VoxelLattice {
    VoxelGrid grid;
    double share = 0.0;  ///< [-] of the faces that fit the lattice
};

/// Recognises a surface whose vertices lie halfway between voxels: nearly all face normals are
/// along the three axes or across one or all voxel diagonals. A flat face is half a voxel side,
/// which gives the edges.
[[nodiscard]] std::optional<VoxelLattice> voxel_lattice(const FaceNormals& faces,
                                                        const std::vector<NormalPeak>& peaks);

}  // namespace vesselbench
