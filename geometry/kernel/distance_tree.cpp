#include "geometry/kernel/distance_tree.h"

namespace vesselbench {

DistanceTree::DistanceTree(const Positions& positions, std::span<const Triangle> triangles)
    : tree(triangle_boxes(positions, triangles)) {
    corners.reserve(triangles.size());
    for (const std::uint32_t t : tree.items())
        corners.push_back(
            {positions[triangles[t][0]], positions[triangles[t][1]], positions[triangles[t][2]]});
    dipoles.resize(tree.nodes().size());
    for (std::size_t at = dipoles.size(); at-- > 0;) dipoles[at] = dipole_of(at);
}

/// Children come after their parent, so they are done first.
Dipole DistanceTree::dipole_of(std::size_t at) const {
    const BoxTree::Node& node = tree.nodes()[at];
    Dipole sum;
    const auto add = [&](const Vec3& area_normal, const Vec3& centre, double area) {
        sum.area_normal += area_normal;
        sum.centre += area * centre;
        sum.area += area;
    };
    if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const TriangleCorners& t = corners[i];
            const Vec3 normal = 0.5 * (t.b - t.a).cross(t.c - t.a);
            add(normal, (t.a + t.b + t.c) / 3.0, normal.norm());
        }
    } else {
        for (const std::size_t child : {at + 1, std::size_t{node.right}})
            add(dipoles[child].area_normal, dipoles[child].centre, dipoles[child].area);
    }
    sum.centre = sum.area > 0.0 ? Vec3(sum.centre / sum.area) : Vec3(node.box.center());
    const Vec3 reach = (node.box.max() - sum.centre).cwiseMax(sum.centre - node.box.min());
    sum.radius = reach.norm();
    return sum;
}

}  // namespace vesselbench
