#include "smoothing/context/cap_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// An edge between the cap and the rest of the surface, or a boundary edge of the cap.
using RimEdge = std::array<VertexId, 2>;

std::vector<RimEdge> rim_edges(const Surface& surface, const Cap& cap) {
    std::vector<RimEdge> edges, rim;
    edges.reserve(3 * cap.triangles.size());
    for (const TriangleId t : cap.triangles)
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(surface.triangles()[t][k],  //
                                            surface.triangles()[t][(k + 1) % 3]);
            if (a != b) edges.push_back({a, b});
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if (end - i == 1) rim.push_back(edges[i]);
    }
    return rim;
}

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double squared = along.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
    return a + t * along;
}

/// The nearest point on some edges.
class NearestEdge {
public:
    NearestEdge(const Positions& points, const std::vector<RimEdge>& edges)
        : points_(points), edges_(edges) {
        std::vector<BoxTree::Box> boxes;
        boxes.reserve(edges.size());
        for (const auto& [a, b] : edges) boxes.push_back(BoxTree::Box(points[a]).extend(points[b]));
        tree_ = BoxTree(boxes);
    }

    [[nodiscard]] Vec3 to(const Vec3& p) const {
        double squared = std::numeric_limits<double>::infinity();
        Vec3 nearest = p;
        tree_.traverse(
            [&](const BoxTree::Box& box) { return box.squaredExteriorDistance(p) < squared; },
            [&](std::uint32_t i) {
                const Vec3 q = closest_on_segment(p, points_[edges_[i][0]], points_[edges_[i][1]]);
                if ((p - q).squaredNorm() >= squared) return;
                squared = (p - q).squaredNorm();
                nearest = q;
            });
        return nearest;
    }

private:
    const Positions& points_;
    const std::vector<RimEdge>& edges_;
    BoxTree tree_;
};

/// Mean direction, weighted by edge length, in which the triangles beyond the rim arrive at it.
Vec3 wall_direction(const Surface& surface, const Cap& cap, const std::vector<RimEdge>& rim) {
    const Positions& x = surface.points();
    Vec3 sum = Vec3::Zero();
    for (const auto& [a, b] : rim) {
        const Vec3 edge = x[b] - x[a];
        for (const TriangleId t : surface.topology->triangles_at().row(a)) {
            const Triangle& corners = surface.triangles()[t];
            if (std::find(corners.begin(), corners.end(), b) == corners.end() ||
                std::binary_search(cap.triangles.begin(), cap.triangles.end(), t))
                continue;
            const auto other =
                std::find_if(corners.begin(), corners.end(),
                             [&, a = a, b = b](VertexId v) { return v != a && v != b; });
            if (other == corners.end() || edge.isZero()) continue;
            const Vec3 up = x[a] - x[*other];
            const Vec3 upright = up - up.dot(edge) / edge.squaredNorm() * edge;
            sum += edge.norm() * upright.normalized();
        }
    }
    return sum;
}

/// How a dome rises: `up` is the cap's unit normal towards the side on which the wall ends, `lean`
/// lies in its plane.
struct Rise {
    Vec3 up, lean;
};

Rise rise_of(const Surface& surface, const Cap& cap, const std::vector<RimEdge>& rim) {
    const Vec3 wall = wall_direction(surface, cap, rim);
    const double along = wall.dot(cap.normal);
    if (!(std::abs(along) > 1e-6 * wall.norm())) return {cap.normal, Vec3::Zero()};
    const Vec3 up = along < 0.0 ? Vec3(-cap.normal) : cap.normal;
    Vec3 lean = wall / std::abs(along) - up;
    if (lean.norm() > 1.0) lean.normalize();
    return {up, lean};
}

void round_cap(const Surface& surface, const Cap& cap, double height, Positions& rounded) {
    const std::vector<RimEdge> rim = rim_edges(surface, cap);
    if (rim.empty()) return;  // a closed flat shape has no inside to dome
    const NearestEdge nearest(surface.points(), rim);
    std::vector<VertexId> inner;
    std::set_difference(cap.vertices.begin(), cap.vertices.end(), cap.rim.begin(), cap.rim.end(),
                        std::back_inserter(inner));
    std::vector<Vec3> inward(inner.size());  // from the rim
    for_each_vertex(inner.size(), [&](std::size_t i) {
        const Vec3& p = surface.points()[inner[i]];
        inward[i] = p - nearest.to(p);
    });
    double radius = 0.0;
    for (const Vec3& way : inward) radius = std::max(radius, way.norm());
    if (!(radius > 0.0)) return;
    const Rise rise = rise_of(surface, cap, rim);
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const double depth = inward[i].norm();
        if (!(depth > 0.0)) continue;
        // The ellipse of conjugate half-axes (inward - lean) and (up + lean), by its angle.
        const double angle = 0.5 * std::numbers::pi * (1.0 - depth / radius);
        const double c = std::cos(angle), s = std::sin(angle);
        rounded[inner[i]] += (radius * (1.0 - s) / depth - 1.0) * inward[i] +
                             height * radius * (c * rise.up + (c + s - 1.0) * rise.lean);
    }
}

}  // namespace

Positions rounded_caps(const Surface& surface, const std::vector<Cap>& caps, double height) {
    require_range("height", height, std::numeric_limits<double>::min(), 2.0);
    if (surface.empty()) return surface.positions ? surface.points() : Positions{};
    Positions rounded = surface.points();
    for (const Cap& cap : caps) round_cap(surface, cap, height, rounded);
    return rounded;
}

}  // namespace vesselbench
