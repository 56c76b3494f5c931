#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/vessel/posing/armature.h"

namespace vesselbench {

/// Turn of each element, from its first to its last point, as a rotation vector in the direction
/// frame at rest [rad]; all rods' elements one after the other.
using Bends = std::vector<Vec3>;

/// A rod's axis where it has been bent to.
struct RodPose {
    Positions points;                       ///< [mm]
    std::vector<Eigen::Quaterniond> turns;  ///< from the direction at rest to the bent one
    std::size_t still = 0;  ///< so many segments from the root are where they were at rest
};

/// A branch's axis before and after, point by point [mm], where it may bend.
struct BentAxis {
    Positions rest, bent;
};

/// A bend that is stronger than a vessel's section allows.
struct SharpBend {
    Vec3 place = Vec3::Zero();  ///< on the bent axis [mm]
    double radius = 0.0;        ///< of the bend [mm]
    double vessel = 0.0;        ///< radius of the vessel [mm]
};

[[nodiscard]] std::size_t element_count(const Armature& armature);

/// Bends the rods, each from its root, which its parent carries. Lengths stay; sections stay
/// perpendicular to the axis.
[[nodiscard]] std::vector<RodPose> pose(const Armature& armature, std::span<const Vec3> bends);

/// Where a point is carried to. Between neighbouring places of an axis the map differs by the turn
/// between them only, so that small errors of the place do not show in the wall; where nothing
/// turned it is the identity.
[[nodiscard]] Vec3 carried(std::span<const RodPose> poses, const Armature& armature,
                           const Binding& binding, const Vec3& rest);

/// Where a point was at rest that is here in the pose.
[[nodiscard]] Vec3 carried_back(std::span<const RodPose> poses, const Armature& armature,
                                const Binding& binding, const Vec3& here);

/// The whole surface; vertices that no rod carries keep their bits.
[[nodiscard]] Positions posed(const Surface& surface, const Armature& armature,
                              std::span<const RodPose> poses);

[[nodiscard]] std::vector<BentAxis> bent_axes(const Armature& armature,
                                              std::span<const RodPose> poses);

/// The strongest bend beyond `least` that is stronger than at rest: radius of curvature below
/// `least` radii of the vessel, measured over one radius to each side.
[[nodiscard]] std::optional<SharpBend> too_sharp(const Armature& armature,
                                                 std::span<const RodPose> poses, double least);

}  // namespace vesselbench
