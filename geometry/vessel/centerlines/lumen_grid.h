#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Index of a voxel in a LumenGrid, i fastest.
using VoxelId = std::uint32_t;

/// The lumen of a surface on a cubic grid. A border of outer voxels makes every 26-neighbour of a
/// lumen voxel a valid index.
struct LumenGrid {
    std::array<int, 3> size = {0, 0, 0};
    Vec3 origin = Vec3::Zero();       ///< centre of voxel 0 [mm]
    double spacing = 1.0;             ///< [mm]
    std::vector<std::uint8_t> lumen;  ///< 1 inside and clear of the wall, #voxels
    std::vector<VoxelId> voxels;      ///< the lumen's voxels, ascending
    std::vector<float> depth;         ///< distance to the wall [mm], #voxels; 0 outside the lumen

    [[nodiscard]] std::array<int, 3> index(VoxelId v) const {
        const int i = static_cast<int>(v) % size[0];
        const int rest = static_cast<int>(v) / size[0];
        return {i, rest % size[1], rest / size[1]};
    }

    [[nodiscard]] VoxelId id(int i, int j, int k) const {
        return static_cast<VoxelId>((k * size[1] + j) * size[0] + i);
    }

    [[nodiscard]] Vec3 centre(VoxelId v) const {
        const auto at = index(v);
        return origin + spacing * Vec3(at[0], at[1], at[2]);
    }

    /// The lumen voxel whose centre is nearest to p within `reach` [mm]; ties by index.
    /// \return false if there is none
    bool nearest(const Vec3& p, double reach, VoxelId& found) const;

    /// Offsets of the 26 neighbours in the voxel arrays, x fastest, without the centre.
    [[nodiscard]] std::array<int, 26> neighbour_offsets() const;

    /// Lengths of these steps [mm].
    [[nodiscard]] std::array<float, 26> neighbour_lengths() const;
};

/// How the crossings of a scan line define its inside.
enum class InsideRule : std::uint8_t {
    Winding,  ///< the winding number is not 0: for consistently oriented triangles
    Parity    ///< an odd number of crossings: for any orientation
};

/// Voxels of the grid that `voxelise` makes around such a box, a border included. Not limited by
/// what an integer can hold.
/// \param box, spacing [mm]
[[nodiscard]] double voxel_count(const Eigen::AlignedBox3d& box, double spacing);

/// Voxels with their centre inside the closed triangles (majority of the scan lines of three axes,
/// so that small defects do no harm) and at least 0.87 voxels away from them: vessels that nearly
/// touch never become neighbours.
/// \param spacing voxel edge [mm]
[[nodiscard]] LumenGrid voxelise(const Positions& points, std::span<const Triangle> triangles,
                                 double spacing, InsideRule rule, const Progress& progress);

/// Fills in `depth`. Source: Felzenszwalb and Huttenlocher, "Distance transforms of sampled
/// functions", Theory of Computing 8, 2012.
/// \throw Cancelled if the user cancels
void measure_depth(LumenGrid& grid, const Progress& cancel);

/// The connected parts of the lumen (26-neighbours), in the order of their first voxels.
struct LumenParts {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> of_voxel;        ///< #voxels; kNone outside the lumen
    std::vector<std::vector<VoxelId>> members;  ///< of each part, from its first voxel outwards
};

/// \throw Cancelled if the user cancels
[[nodiscard]] LumenParts lumen_parts(const LumenGrid& grid, const Progress& cancel = {});

/// Keeps the voxels whose component has at least `fraction` of the largest one's voxels
/// (26-neighbours).
/// \return the number of components kept
std::size_t keep_large_components(LumenGrid& grid, double fraction);

/// Shortest path length [mm] through the lumen from a voxel to every lumen voxel that a path leads
/// to, whose distances are set. \return these voxels, the nearest first
/// \param distances #voxels, infinite for the voxels to reach
/// \throw Cancelled if the user cancels
std::vector<VoxelId> add_geodesic_distances(const LumenGrid& grid, VoxelId from,
                                            std::vector<float>& distances, const Progress& cancel);

}  // namespace vesselbench
