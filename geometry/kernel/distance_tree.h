#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/box_tree.h"

namespace vesselbench {

struct TriangleCorners {
    Vec3 a, b, c;
};

/// A node's triangles as seen from a distance.
struct Dipole {
    Vec3 area_normal = Vec3::Zero();  ///< [mm^2]
    Vec3 centre = Vec3::Zero();       ///< area-weighted [mm]
    double area = 0.0;                ///< [mm^2]
    double radius = 0.0;              ///< of the sphere around centre that contains the node [mm]
};

/// A node is far if its distance exceeds this many of its radii; its dipole then errs by less than
/// about 1 % of its solid angle.
constexpr double kFarFactor = 2.5;

/// The data that SurfaceDistance, or a device, searches: triangles in a tree of boxes, each node
/// with its dipole for winding numbers (Barill et al. 2018).
struct DistanceTree {
    BoxTree tree;
    std::vector<TriangleCorners> corners;  ///< in the order of the tree's items
    std::vector<Dipole> dipoles;           ///< per node

    DistanceTree(const Positions& positions, std::span<const Triangle> triangles);

private:
    [[nodiscard]] Dipole dipole_of(std::size_t at) const;
};

}  // namespace vesselbench
