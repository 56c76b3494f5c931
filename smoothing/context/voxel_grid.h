#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Voxels of the image that a surface comes from.
struct VoxelGrid {
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< unit columns at right angles
    Vec3 spacing = Vec3::Ones();                         ///< [mm] along them

    static constexpr double kCubic = 1.2;  ///< largest ratio of edges without a stack axis

    /// The column of the longest edge; the last of equals, along which images are stacked.
    [[nodiscard]] int longest() const;

    /// True if no edge is more than a fifth longer than another: there is no stack axis.
    [[nodiscard]] bool is_cubic() const;
};

/// Reads the grid from the triangles. Surfaces are extracted from cell to cell between the voxels,
/// so most edges of triangles lie in the cells' sides: at a right angle to an axis, whatever the
/// intensities and their noise are. Vertices on the grid's lines give the distances of the planes.
/// None if the vertices were moved since, or lie halfway between voxels, as those of masks do
/// (normal_peaks.h). The same for any number of threads.
[[nodiscard]] std::optional<VoxelGrid> interpolated_grid(const Topology& topology,
                                                         const Positions& positions);

/// True if nearly all faces have one of the 13 directions that the surface of a mask may have:
/// across the sides and the diagonals of the grid's cells.
[[nodiscard]] bool is_of_mask(const Topology& topology, const Positions& positions,
                              const VoxelGrid& grid);

/// The directions of a mask's faces: unit, 13.
[[nodiscard]] std::vector<Vec3> mask_directions(const VoxelGrid& grid);

}  // namespace vesselbench
