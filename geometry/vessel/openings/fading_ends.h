#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/openings/surface_ends.h"

namespace vesselbench {

/// The edges of an image's voxels [mm], a column each.
using VoxelEdges = Eigen::Matrix3d;

/// A vessel beside the voxels across it.
struct VoxelWidth {
    double diameter = 0.0;        ///< of the vessel [mm]
    double voxels = 0.0;          ///< a thinner vessel has gaps between layers of voxels [mm]
    double lower_quartile = 0.0;  ///< of their ratio along all of the branch [-]

    /// The image cannot show whether the vessel ends there. Surfaces of masks are 20 to 40 %
    /// thinner than vessels this thin. A branch is shown up to its end if it is wider almost
    /// everywhere else: it neither breaks nor nearly does.
    [[nodiscard]] bool is_fading() const {
        constexpr double kLeast = 0.7, kLeastElsewhere = 0.6;
        return diameter < kLeast * voxels && lower_quartile < kLeastElsewhere;
    }
};

/// Diameter and voxels are means over a branch's last three diameters, without the rounded tip.
/// Sections of a vessel in neighbouring layers of voxels overlap if it is wider than the layers'
/// distance times the sine of the angle between the vessel and the layers' axis.
[[nodiscard]] VoxelWidth width_at_tip(const CenterlineGraph& graph, std::size_t tip,
                                      const VoxelEdges& voxels);

/// By end, the other end that a closed end faces across a gap of at most three diameters: each lies
/// within 45 degrees of where the other one points. Such a vessel is broken, or occluded.
[[nodiscard]] std::vector<std::optional<std::size_t>> facing_ends(
    const std::vector<SurfaceEnd>& ends, const CenterlineGraph& graph);

}  // namespace vesselbench
