#include "geometry/vessel/openings/collision.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Box = Eigen::AlignedBox3d;

Kernel::Triangle_3 exact(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
    return {point(a), point(b), point(c)};
}

Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    Box box(a);
    box.extend(b);
    box.extend(c);
    return box;
}

}  // namespace

std::vector<std::uint8_t> touching(const Surface& surface, std::span<const Corners> probes) {
    std::vector<std::uint8_t> hits(probes.size(), 0);
    Box reach;
    for (const auto& [a, b, c] : probes) reach.extend(box_of(a, b, c));
    Triangles near;
    const Positions& x = surface.points();
    for (const auto& [a, b, c] : surface.triangles())
        if (reach.intersects(box_of(x[a], x[b], x[c])))
            if (const auto triangle = exact(x[a], x[b], x[c]); !triangle.is_degenerate())
                near.push_back(triangle);
    if (near.empty()) return hits;
    const Tree tree(near.cbegin(), near.cend());
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const auto probe = exact(probes[i][0], probes[i][1], probes[i][2]);
        hits[i] = !probe.is_degenerate() && tree.do_intersect(probe) ? 1 : 0;
    }
    return hits;
}

}  // namespace vesselbench
