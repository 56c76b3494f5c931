#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/ends/surface_ends.h"

namespace vesselbench {

/// The edges of an image's voxels [mm], a column each.
using VoxelEdges = Eigen::Matrix3d;

/// What is measured of a candidate for a vessel's end, once. Diameters are those of inscribed
/// spheres, but for `neck`.
struct EndProfile {
    double length = 0.0;    ///< of its own vessel, beyond its parent's inscribed spheres [mm]
    double diameter = 0.0;  ///< median along that length [mm]
    double widest = 0.0;    ///< along that length [mm]
    double neck = 1.0;      ///< a section's diameter over a smaller one nearer to the parent [-]
    double taper = 1.0;     ///< mean diameter of the outer third over that of the inner third [-]
    double parent = 0.0;    ///< of the widest other vessel at its furcation [mm]; 0: there is none
    std::vector<double> others;  ///< cubes of the diameters of the other vessels there [mm^3]
    double tree = 0.0;           ///< of the widest other vessel of the tree [mm]
    double across = 0.0;         ///< voxels of the image, or edges of the surface, across it [-]
    bool rim = false;            ///< an open border of the surface
    bool cap = false;            ///< a cap with a label
    /// Of a blind end or a branch without a line: share of the flow through rims and named caps [-]
    double visible_beside = 0.0;

    /// Another vessel at its furcation. \param course its diameter [mm]
    void add_other(double course) {
        parent = course > parent ? course : parent;
        others.push_back(course * course * course);
    }

    /// Sum of the others [mm^3].
    [[nodiscard]] double other_flow() const {
        return std::accumulate(others.begin(), others.end(), 0.0);
    }

    /// How much nearer its furcation comes to Murray's law by its flow [-]: a trunk is missing
    /// without it, and a sac disturbs.
    [[nodiscard]] double need() const;
};

/// Dimensionless, in the order of `kEndFeatures`.
inline constexpr std::array<std::string_view, 14> kEndFeatures = {
    "one",  "length",   "short", "neck",   "beside_parent", "surplus", "beside_tree",
    "need", "widening", "taper", "across", "rim",           "cap",     "visible_beside"};

using EndFeatures = std::array<double, kEndFeatures.size()>;

[[nodiscard]] EndFeatures features_of(const EndProfile& profile);

/// What profiles are measured on.
struct EndScene {
    const Surface& surface;
    const CenterlineGraph& graph;
    std::optional<VoxelEdges> voxels;  ///< of the image that the surface was made from
    bool border_cuts = false;          ///< as OpeningPlanOptions
};

/// Of all candidates for a vessel's end.
struct EndProfiles {
    std::vector<EndProfile> ends;   ///< by end
    std::vector<EndProfile> stubs;  ///< by blind branch without a line
};

/// \param ends as from find_surface_ends
/// \param stubs of the same lines
/// \throw Cancelled
[[nodiscard]] EndProfiles profiles_of(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                                      const std::vector<Stub>& stubs,
                                      const Progress& progress = {});

}  // namespace vesselbench
