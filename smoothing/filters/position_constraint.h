#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Node position constraint: every vertex stays in a cell centred on its start position.
/// Source: Gibson, "Constrained elastic surface nets", 1998 (voxel cells); Bade, Konrad, Preim,
/// "Reducing artifacts in surface meshes extracted from binary volumes", 2007 (diamond cells);
/// thesis 3.3.4.
struct PositionConstraint {
    enum class Cell {
        Voxel,   ///< box: half of `size` to each side along the axes
        Diamond  ///< octahedron with its corners at the centres of that box's faces
    };

    Cell cell = Cell::Voxel;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< unit columns: the image's axes
    Vec3 size = Vec3::Ones();                            ///< of the voxels along the axes [mm], > 0

    /// The position itself if it lies in the cell around `start`, bit for bit; else the nearest
    /// point of the box, or the point where the path from `start` leaves the diamond.
    [[nodiscard]] Vec3 clamped(const Vec3& start, const Vec3& position) const;
};

/// \throw InvalidInput unless the axes are orthonormal and the sizes positive and finite
void require_valid(const PositionConstraint& constraint);

}  // namespace vesselbench
